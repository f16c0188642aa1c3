//! The solver for the live page: `crates/live` as WebAssembly, kept packed in `crates/report`.
//!
//! Where the installed Rust has no library for WebAssembly and rustup brings none, Debian's compiler for the web and the sources of
//! its library are unpacked under `target/wasm`; nothing is installed, and the sources are built with the crates (`-Z build-std`).
//! The module is renewed when a part of the solver is finished, and a test says when its answers are no longer the solver's.

use crate::generate;
use crate::step::{Outcome, Step, entries, exists, read, root, target};
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";
/// Where the module is kept.
const KEPT: &str = "crates/report/src/live.wasm.gz";
/// The page around the module, which stands in it as base64, stays below this, bytes.
const MOST: u64 = 4_000_000;
const PAGE: &str = "crates/report/src/live.html";
/// The live page of the documentation, and the models in its menu.
const SHOWN: &str = "docs/live.html";
const MODELS: [&str; 6] =
    ["six_rod_robot", "lee_frame", "sensor_clamp", "four_bar", "tendon_robot", "cross_spring_pivot"];

/// Builds the module and packs it, and makes the page of the documentation with it.
pub fn build() -> Outcome {
    module()?;
    generate::build()?;
    page()
}

/// One page of several results, each of which can be solved again.
fn page() -> Outcome {
    let folder = target().join("pages/live");
    let program = target().join("debug").join(format!("flexura{}", std::env::consts::EXE_SUFFIX));
    let program = program.display().to_string();
    let mut page =
        Step::new("the live page of the documentation", &format!("{program} view --live --no-open -o"));
    page = page.argument(root().join(SHOWN));
    for name in MODELS {
        let into = folder.join(name);
        let model = format!("models/{name}.toml");
        Step::new("an example", &format!("{program} solve {model} --quiet -o")).argument(&into).run()?;
        page = page.argument(into.join("result.json"));
    }
    page.run()
}

/// The live page of the documentation must hold the module that is kept.
pub fn check() -> Outcome {
    let (page, module) = (read(&root().join(SHOWN))?, root().join(KEPT));
    let module = Step::new("the module", "base64 -w 0").argument(module).output()?;
    if page.contains(module.trim()) {
        return Ok(());
    }
    Err(format!("{SHOWN} holds another solver than {KEPT}; mend that with\n\n    cargo xtask live\n"))
}

fn module() -> Outcome {
    let words = format!("cargo build -p flexura-live --profile wasm --target {TARGET}");
    let folder = target().join("wasm/build");
    let step = if has_library() || (exists("rustup --version") && add_library()) {
        Step::new("the solver for the page", &words)
    } else {
        let compiler = compiler()?;
        Step::new("the solver for the page", &format!("{words} -Z build-std=std,panic_abort"))
            .variable("RUSTC", compiler.display().to_string())
            .variable("RUSTC_BOOTSTRAP", "1")
            .variable("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker()?.display().to_string())
    };
    // Every browser of the last years has vectors.
    let mut flags = "-C target-feature=+simd128".to_owned();
    // Where the sources of libraries stand on this machine is nobody's business.
    if let Some(home) = std::env::home_dir() {
        let cargo = std::env::var_os("CARGO_HOME").map_or_else(|| home.join(".cargo"), PathBuf::from);
        flags += &format!(" --remap-path-prefix={}=cargo", cargo.display());
        flags += &format!(" --remap-path-prefix={}=home", home.display());
    }
    step.variable("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", &flags)
        .variable("CARGO_TARGET_DIR", folder.display().to_string())
        .run()?;
    let built = folder.join(TARGET).join("wasm/flexura_live.wasm");
    let packed = folder.join("live.wasm.gz");
    pack(&built, &packed)?;
    let size =
        |path: &Path| std::fs::metadata(path).map(|data| data.len()).map_err(|error| error.to_string());
    let (plain, small) = (size(&built)?, size(&packed)?);
    let page = size(&root().join(PAGE))? + small.div_ceil(3) * 4;
    println!("    {plain} bytes, packed {small}; a live page has {page} without its result");
    if page > MOST {
        return Err(format!("a live page may have {MOST} bytes"));
    }
    std::fs::copy(&packed, root().join(KEPT)).map_err(|error| format!("{KEPT}: {error}"))?;
    Ok(())
}

/// Has the installed Rust a library for WebAssembly?
fn has_library() -> bool {
    let output = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    output.is_ok_and(|output| {
        let path = String::from_utf8_lossy(&output.stdout);
        entries(Path::new(path.trim())).is_ok_and(|files| !files.is_empty())
    })
}

/// Does rustup bring one?
fn add_library() -> bool {
    Step::new("a library for WebAssembly", &format!("rustup target add {TARGET}")).run().is_ok()
        && has_library()
}

/// The linker that comes with Rust.
fn linker() -> Result<PathBuf, String> {
    let output = Step::new("where Rust is", "rustc --print sysroot").output()?;
    let library = Path::new(output.trim()).join("lib/rustlib");
    let found =
        entries(&library)?.into_iter().map(|folder| folder.join("bin/rust-lld")).find(|path| path.is_file());
    found.ok_or_else(|| format!("there is no rust-lld under {}; install Rust by rustup", library.display()))
}

/// Debian's compiler for the web with its sources, unpacked; a script that runs it with its own libraries.
fn compiler() -> Result<PathBuf, String> {
    let folder = target().join("wasm");
    let (script, unpacked) = (folder.join("rustc"), folder.join("root"));
    if script.is_file() {
        return Ok(script);
    }
    if !exists("apt-get --version") || !exists("dpkg --version") {
        return Err(format!("this Rust cannot build for {TARGET}; add it with `rustup target add {TARGET}`"));
    }
    let debs = folder.join("debs");
    let made =
        |path: &Path| std::fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()));
    made(&debs)?;
    made(&unpacked)?;
    Step::new("package lists", "apt-get update -qq").run()?;
    let mut packages = vec!["rustc-web".to_owned(), "rust-web-src".to_owned()];
    let mut next = 0;
    while next < packages.len() {
        let text = Step::new("what it needs", &format!("apt-cache depends {}", packages[next])).output()?;
        for name in needed(&text) {
            if !packages.contains(&name) {
                packages.push(name);
            }
        }
        next += 1;
    }
    for package in packages {
        // Into the folder where it stands.
        let fetch = format!("env -C {} apt-get download -qq {package}", debs.display());
        Step::new("a package of Rust for the web", &fetch).run()?;
    }
    for package in entries(&debs)? {
        Step::new("unpacking", "dpkg -x").argument(&package).argument(&unpacked).run()?;
    }
    let libraries = unpacked.join(format!("usr/lib/{}-linux-gnu", std::env::consts::ARCH));
    let text = format!(
        "#!/bin/sh\nexport LD_LIBRARY_PATH='{}'\nexec '{}' \"$@\"\n",
        libraries.display(),
        unpacked.join("usr/bin/rustc").display()
    );
    std::fs::write(&script, text).map_err(|error| format!("{}: {error}", script.display()))?;
    Step::new("the compiler may be run", "chmod +x").argument(&script).run()?;
    Ok(script)
}

/// Rust's own libraries among the packages that one depends on.
fn needed(depends: &str) -> Vec<String> {
    let names = depends.lines().filter_map(|line| line.trim().strip_prefix("Depends: "));
    let own = |name: &&str| name.starts_with("libstd-rust-web") || name.starts_with("libllvm");
    names.filter(own).map(str::to_owned).collect()
}

/// Without name and time, so that the same module packs to the same bytes.
fn pack(from: &Path, to: &Path) -> Outcome {
    let copy = to.with_extension("");
    // The content alone: a module is no program that a shell could run.
    let content = std::fs::read(from).map_err(|error| format!("{}: {error}", from.display()))?;
    std::fs::write(&copy, content).map_err(|error| format!("{}: {error}", copy.display()))?;
    Step::new("packing", "gzip -9 -n -f").argument(&copy).run()
}

#[cfg(test)]
mod tests {
    #[test]
    fn only_rusts_own_libraries_are_fetched_besides() {
        let text = "rustc-web\n  Depends: libc6\n  Depends: libstd-rust-web-dev\n  Depends: <libc-dev>\n    libc6-dev\n  \
                    Conflicts: rustc\n  Depends: libllvm22\n";
        assert_eq!(super::needed(text), ["libstd-rust-web-dev", "libllvm22"]);
    }
}
