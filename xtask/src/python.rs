//! A Python of our own with the packages that the tests need, kept between runs.

use crate::step::{Outcome, Step, exists, read, root, target};
use std::path::{Path, PathBuf};

const OLD: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// The interpreter that tests use, made when it is not there or its packages changed.
pub fn prepare() -> Result<PathBuf, String> {
    let folder = target().join("python");
    let program = if cfg!(windows) { folder.join("Scripts/python.exe") } else { folder.join("bin/python") };
    let requirements = root().join("xtask/requirements.txt");
    let wanted = read(&requirements)?;
    let stamp = folder.join("installed.txt");
    if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) && runs(&program) {
        return Ok(program);
    }
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    Step::new("Python environment", &format!("{} -m venv", newest()?)).argument(&folder).run()?;
    let install = "-m pip install --quiet --disable-pip-version-check --requirement";
    let mut step = Step::new("Python packages", "").argument(&program);
    for word in install.split(' ') {
        step = step.argument(word);
    }
    step.argument(&requirements).run()?;
    std::fs::write(&stamp, wanted).map_err(|error| format!("{}: {error}", stamp.display()))?;
    Ok(program)
}

fn runs(program: &Path) -> bool {
    program.is_file() && exists(&format!("{} --version", program.display()))
}

/// A Python that is new enough, under any of its usual names.
fn newest() -> Result<String, String> {
    for name in ["python3", "python3.14", "python3.13", "python3.12", "python3.11", "python"] {
        let check = std::process::Command::new(name).args(["-c", OLD]).status();
        if check.is_ok_and(|status| status.success()) {
            return Ok(name.to_owned());
        }
    }
    Err("Python 3.11 or newer is needed for the tests, with its venv module (Debian: apt-get install python3-venv)".into())
}

/// The schema is a valid one, and every model keeps to it: judged by two tools that are not ours.
pub fn check_schema(python: &Path) -> Outcome {
    Step::new("schema and models", "")
        .argument(python)
        .argument("xtask/check_schema.py")
        .argument(target().join("schema_check"))
        .run()
}
