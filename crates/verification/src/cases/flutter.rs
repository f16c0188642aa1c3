//! Spectra where loads have no energy.

use super::modes::{compared, found};
use crate::{Case, Row};
use flexura_solution::ModeKind;

pub const CASES: [Case; 1] = [Case {
    id: "modes_without_energy",
    title: "Beck's column at PL²/EI = 10, below its flutter load; a round cantilever under a tangential torque TL/EI = 1, which flutters \
            under any",
    citation: "power series in 25 digits (M. Beck, *ZAMP* 3 (1952) 225)",
    needed: "1e-8",
    run: spectra,
    closed_form: None,
}];

fn cantilever(section: &str, load: &str) -> String {
    format!(
        "[section.rod]\nshape = \"stiffness\"\n{section}\nmass_per_length = 1\n[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\n\
         start = {{ body = \"ground\", hold = \"clamp\" }}\n[load.tip]\nbeam = \"rod\"\nat = 1.0\n{load}\n"
    )
}

fn spectra() -> Result<Vec<Row>, String> {
    let planar = "GJ = 1e4\nEI2 = 1e4\nEI3 = 1";
    let push = "force = [-10, 0, 0]\nframe = \"local\"";
    let modes = found(&cantilever(planar, push), 3)?;
    let mut rows = compared("Beck's column", &modes, &[5.1757622613, 18.586794893, 57.853034497], 1.0);
    let growing = modes.unstable();
    rows.push(Row::absolute("modes that grow, Beck's column", 0.0, growing as f64, 0.0));
    let torque = "moment = [1, 0, 0]\nframe = \"local\"";
    let modes = found(&cantilever("GJ = 0.8\nEI2 = 1\nEI3 = 1", torque), 2)?;
    for (mode, sign, kind) in modes
        .modes
        .iter()
        .zip([1.0, -1.0])
        .zip([ModeKind::Flutter, ModeKind::Decaying])
        .map(|((m, s), k)| (m, s, k))
    {
        rows.push(Row::relative(format!("ω, {}", kind.word()), 3.5131118669, mode.rate, 1e-8));
        rows.push(Row::relative(format!("growth, {}", kind.word()), sign * 0.54122022255, mode.growth, 1e-8));
        rows.push(Row::absolute(
            format!("is {}", kind.word()),
            1.0,
            f64::from(u8::from(mode.kind == kind)),
            0.0,
        ));
    }
    Ok(rows)
}
