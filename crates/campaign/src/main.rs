//! `flexura-campaign --command PATH --models DIR --out DIR --seed S --count N [--jobs J]`; `--draw` writes the mechanisms only.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a campaign talks to a terminal")]

use flexura_campaign::{Progress, Settings, mechanism, run};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

const USAGE: &str = "usage: cargo xtask campaign [--seed S] [--count N] [--jobs J] [--quick] [--draw]\n\
                     S, the first seed [default: 1]; N, how many [default: 200]; J, at a time [default: as many as cores];\n\
                     --quick checks and solves only, --draw writes the mechanisms into target/campaign and puts them to no verb";

struct Asked {
    settings: Settings,
    draw: bool,
}

fn asked() -> Result<Asked, String> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut settings = Settings {
        command: PathBuf::from("target/release/flexura"),
        models: PathBuf::from("models"),
        out: PathBuf::from("target/campaign"),
        seed: 1,
        count: 200,
        jobs: cores,
        quick: false,
    };
    let mut draw = false;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        if word == "--draw" {
            draw = true;
            continue;
        }
        if word == "--quick" {
            settings.quick = true;
            continue;
        }
        let value =
            words.next().ok_or_else(|| format!("`{word}` is no flag, or its value is missing\n{USAGE}"))?;
        let number = || value.parse::<u64>().map_err(|_| format!("`{value}` is no whole number for {word}"));
        match word.as_str() {
            "--command" => settings.command = value.into(),
            "--models" => settings.models = value.into(),
            "--out" => settings.out = value.into(),
            "--seed" => settings.seed = number()?,
            "--count" => settings.count = number()?,
            "--jobs" => settings.jobs = number()?.clamp(1, 256) as usize,
            _ => return Err(format!("`{word}` is no flag\n{USAGE}")),
        }
    }
    let whole = |path: &PathBuf| std::path::absolute(path).map_err(|error| error.to_string());
    settings.command = whole(&settings.command)?;
    settings.out = whole(&settings.out)?;
    Ok(Asked { settings, draw })
}

fn main() -> ExitCode {
    let asked = match asked() {
        Ok(asked) => asked,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let settings = &asked.settings;
    if asked.draw {
        return drawn(settings);
    }
    let start = Instant::now();
    let tell = |progress: Progress| match progress {
        Progress::Found(found) => {
            let damaged = if found.is_damaged { " (damaged)" } else { "" };
            println!("{} seed {}{damaged}: {}", found.finding.kind, found.seed, found.finding.detail);
        }
        Progress::Seed { done, .. } if done % 100 == 0 => {
            println!("-- {done} of {} after {:.0} s", settings.count, start.elapsed().as_secs_f64());
        }
        Progress::Seed { .. } => {}
    };
    match run(settings, &tell) {
        Ok(summary) => {
            println!("\n{}", summary.table());
            println!("files in {}", settings.out.display());
            if summary.found.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            eprintln!("{}: {error}", settings.out.display());
            ExitCode::from(3)
        }
    }
}

fn drawn(settings: &Settings) -> ExitCode {
    let write = || -> std::io::Result<()> {
        std::fs::create_dir_all(&settings.out)?;
        for seed in settings.seed..settings.seed + settings.count {
            std::fs::write(settings.out.join(format!("{seed}.toml")), mechanism(seed).text)?;
        }
        Ok(())
    };
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", settings.out.display());
            ExitCode::from(3)
        }
    }
}
