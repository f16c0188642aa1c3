//! What benches share: bundled models, and medians of wall time.
#![allow(dead_code, reason = "every bench uses a part of it")]

use flexura::model::Model;
use flexura::modelfile::Document;
use std::time::Instant;

/// A bundled model file.
pub fn document(file: &str) -> Document {
    let path = format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR"));
    Document::read(path).expect("a bundled model")
}

/// A bundled model with its own values.
pub fn read(file: &str) -> Model {
    document(file).model(&[]).expect("a good model")
}

/// Median of seconds of one run, in batches that last long enough to be measured; the first run only warms up.
pub fn median(mut run: impl FnMut()) -> f64 {
    let start = Instant::now();
    run();
    let once = start.elapsed().as_secs_f64().max(1e-8);
    let batch = ((2e-3 / once) as usize).clamp(1, 10_000);
    // A run of a tenth of a second is not repeated as often.
    let count = if once > 0.1 { 9 } else { 15 };
    let mut times: Vec<f64> = (0..count)
        .map(|_| {
            let start = Instant::now();
            (0..batch).for_each(|_| run());
            start.elapsed().as_secs_f64() / batch as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
