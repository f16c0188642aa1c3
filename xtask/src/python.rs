//! A Python of our own with the packages that the tests need, kept between runs.

use crate::step::{Outcome, Step, entries, exists, read, root, target};
use crate::viewer;
use std::path::{Path, PathBuf};

const OLD: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// The interpreter that tests use, made when it is not there or its packages changed.
pub fn prepare() -> Result<PathBuf, String> {
    environment("python", "xtask/requirements.txt")
}

/// An environment below `target`, made when it is not there or its packages changed; its interpreter.
fn environment(name: &str, requirements: &str) -> Result<PathBuf, String> {
    let folder = target().join(name);
    let program = if cfg!(windows) { folder.join("Scripts/python.exe") } else { folder.join("bin/python") };
    let requirements = root().join(requirements);
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
    words(Step::new("Python packages", "").argument(&program), install).argument(&requirements).run()?;
    std::fs::write(&stamp, wanted).map_err(|error| format!("{}: {error}", stamp.display()))?;
    Ok(program)
}

fn words<'a>(step: Step<'a>, words: &str) -> Step<'a> {
    words.split_whitespace().fold(step, |step, word| step.argument(word))
}

/// Builds the wheel as `pip install .` does, but with the optimisation of the tests; installs it where nothing else of ours
/// is, and tests it from outside the checkout.
pub fn test_package(python: &Path) -> Outcome {
    let wheels = target().join("wheels");
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    }
    let build = Step::new("Python package", "").argument(python);
    words(build, "-m maturin build --quiet --profile dev --out")
        .argument(&wheels)
        .variable("CARGO_PROFILE_DEV_OPT_LEVEL", "2")
        .run()?;
    let [wheel] = &entries(&wheels)?[..] else {
        return Err(format!("{} should hold one wheel", wheels.display()));
    };
    let clean = environment("python-package", "python/tests/requirements.txt")?;
    let install = Step::new("Python package in a clean environment", "").argument(&clean);
    words(install, "-m pip install --quiet --disable-pip-version-check --force-reinstall --no-deps")
        .argument(wheel)
        .run()?;
    let outside = std::env::temp_dir();
    let at = |path: &str| root().join(path);
    let tests = Step::new("tests of the Python package", "").argument(&clean);
    words(tests, "-m pytest -p no:cacheprovider -c")
        .argument(at("pyproject.toml"))
        .argument("--rootdir")
        .argument(root())
        .argument(at("python/tests"))
        .folder(&outside)
        .run()?;
    for what in [&["-p", "flexura"][..], &["python/tests", "python/tables.py"]] {
        let types = Step::new("types of the Python package", "").argument(&clean);
        let types = words(types, "-m mypy --config-file").argument(at("pyproject.toml"));
        what.iter().fold(types, |step, word| step.argument(word)).run()?;
    }
    let stubs = Step::new("stubs of the Python package", "").argument(&clean);
    words(stubs, "-m mypy.stubtest --ignore-missing-stub flexura._native").folder(&outside).run()?;
    test_torch(wheel)
}

/// Gradients by PyTorch: by Debian's, since that of the Python registry takes gigabytes, in an environment that sees it and the
/// wheel.
fn test_torch(wheel: &Path) -> Outcome {
    const DEBIAN: &str = "/usr/bin/python3";
    let there = || {
        let import = std::process::Command::new(DEBIAN).args(["-c", "import torch"]).output();
        import.is_ok_and(|output| output.status.success())
    };
    if !there() {
        if !exists("apt-get --version") {
            println!("    gradients by PyTorch left out: they are tested with Debian's");
            return Ok(());
        }
        viewer::debian(&["python3-torch", "python3-venv"])?;
    }
    let folder = target().join("python-torch");
    let program = folder.join("bin/python");
    if !runs(&program) {
        let venv =
            Step::new("Python environment with PyTorch", &format!("{DEBIAN} -m venv --system-site-packages"));
        venv.argument(&folder).run()?;
    }
    let install = Step::new("Python package beside PyTorch", "").argument(&program);
    words(install, "-m pip install --quiet --disable-pip-version-check --force-reinstall --no-deps")
        .argument(wheel)
        .run()?;
    let install = Step::new("its test runner", "").argument(&program);
    words(install, "-m pip install --quiet --disable-pip-version-check pytest==9.2.0").run()?;
    let tests = Step::new("gradients by PyTorch", "").argument(&program);
    words(tests, "-m pytest -q -p no:cacheprovider -c /dev/null --rootdir")
        .argument(root())
        .argument(root().join("python/tests/test_torch.py"))
        .folder(std::env::temp_dir())
        .run()
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
