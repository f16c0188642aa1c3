//! The campaign, built with full optimisation and started.

use crate::step::{Outcome, Step, target};

/// Builds the command and the campaign, and hands the flags on.
pub fn run(flags: impl Iterator<Item = String>) -> Outcome {
    Step::new(
        "the command and the campaign",
        "cargo build --release --package flexura-cli --package flexura-campaign",
    )
    .run()?;
    let program =
        |name: &str| target().join("release").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    let step = Step::new("campaign", &program("flexura-campaign").display().to_string())
        .argument("--command")
        .argument(program("flexura"));
    flags.fold(step, |step, flag| step.argument(flag)).run()
}
