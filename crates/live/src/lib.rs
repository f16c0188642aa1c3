//! The solver inside a page: a model's text goes in, result documents come out, step by step from where it stands.
//!
//! Built for WebAssembly (`cargo xtask live`), it is what the page of `--live` runs in a worker. A call is a JSON text, and so is
//! its answer: [`Live::answer`] serves the page, by way of the module's C interface, and native tests alike.
//!
//! ```
//! let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/elastica.toml"))?;
//! let mut live = flexura_live::Live::default();
//! let open = serde_json::json!({ "do": "open", "text": text, "name": "elastica.toml" });
//! let answer: serde_json::Value = serde_json::from_str(&live.answer(&open.to_string()))?;
//! assert_eq!(answer["problems"].as_array().map(Vec::len), Some(0));
//! let answer: serde_json::Value = serde_json::from_str(&live.answer(r#"{ "do": "solve" }"#))?;
//! assert_eq!(answer["document"]["status"], "converged");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Absent on purpose: clocks, threads, files. A study that takes long is ended by ending the worker.

mod abi;
mod grip;
mod problems;
mod ranges;
mod request;
mod session;
mod studies;

use problems::Trouble;
use request::{Answer, Opened, Request};
use session::Session;

/// What the page talks to.
#[derive(Default)]
pub struct Live {
    session: Option<Session>,
}

impl Live {
    /// Does what a request asks for; both are JSON texts.
    pub fn answer(&mut self, request: &str) -> String {
        let answer = match serde_json::from_str::<Request>(request) {
            Ok(request) => self
                .act(request)
                .unwrap_or_else(|trouble| Answer { problems: trouble.0, ..Answer::default() }),
            Err(error) => Trouble::plain(format!("the request is not understood: {error}")).into(),
        };
        serde_json::to_string(&answer).unwrap_or_else(|error| {
            // A number that JSON cannot hold.
            let answer = Answer::from(Trouble::plain(error.to_string()));
            serde_json::to_string(&answer).unwrap_or_default()
        })
    }

    fn act(&mut self, request: Request) -> Result<Answer, Trouble> {
        if let Request::Open { text, name, set, inverse } = request {
            let session = Session::open(&text, &name, &set, inverse)?;
            let opened = Opened::of(&session);
            let problems = session.warnings();
            self.session = Some(session);
            return Ok(Answer { opened: Some(opened), problems, ..Answer::default() });
        }
        let session = self.session.as_mut().ok_or_else(|| Trouble::plain("no model is open".to_owned()))?;
        match request {
            Request::Open { .. } => Ok(Answer::default()),
            Request::Solve { samples } => session.solve(samples),
            Request::Step { values, set, samples } => session.step(&values, &set, samples),
            Request::Grips {} => Ok(Answer { grips: Some(session.grips()), ..Answer::default() }),
            Request::Drag { grip, to, eye, samples } => session.drag(grip, to, eye, samples),
            Request::Release {} => session.release(),
            Request::Study { name } => session.study(&name),
            Request::Trace { parameter, range } => session.trace(&parameter, range),
            Request::Stability {} => session.stability(),
        }
    }
}

#[cfg(test)]
mod tests;
