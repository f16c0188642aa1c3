//! Writing to the two streams. Colours are dropped where a stream is no terminal or NO_COLOR is set.

use crate::failure::Failure;
use clap::builder::styling::{AnsiColor, Style};
use flexura::model::{visible, visible_lines};
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

pub const BOLD: Style = Style::new().bold();
pub const GOOD: Style = AnsiColor::Green.on_default().bold();
pub const BAD: Style = AnsiColor::Red.on_default().bold();
pub const NOTE: Style = AnsiColor::Yellow.on_default().bold();
pub const DIM: Style = Style::new().dimmed();

/// Text in a style.
pub fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// Codes of the styles that the command, its messages and its help use: nothing that hides a text.
const STYLES: [&str; 16] =
    ["0", "1", "2", "4", "31", "32", "33", "34", "35", "36", "91", "92", "93", "94", "95", "96"];
/// Characters of the longest title.
const TITLE: usize = 100;

/// The text with its styles, and with everything else that would steer the terminal written out: names, titles and lines of
/// files come from anywhere.
fn safe(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('\u{1b}') {
        shown += &visible_lines(&rest[..at]);
        let style = STYLES.iter().map(|code| format!("\u{1b}[{code}m"));
        let style = style.into_iter().find(|style| rest[at..].starts_with(style));
        let (what, length) = style.map_or(("\\u001B".to_owned(), 1), |style| (style.clone(), style.len()));
        shown += &what;
        rest = &rest[at + length..];
    }
    shown + &visible_lines(rest)
}

/// What a mechanism is called in the first line of a summary.
pub fn title(model: &str) -> String {
    if model.is_empty() { "mechanism".to_owned() } else { shortened(&visible(model), TITLE) }
}

/// A text of at most that many characters. Its middle goes, for names of one kind often differ at their ends.
pub fn shortened(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let last = most / 3;
    let first = text.chars().take(most - last - 1);
    first.chain(['…']).chain(text.chars().skip(count - last)).collect()
}

/// Writes what a person reads to standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    print_table(&safe(text))
}

/// Writes a document or table, which hold nothing that steers a terminal, to standard output. A reader that has gone away
/// (`| head`) is no failure.
pub fn print_table(text: &str) -> Result<(), Failure> {
    let mut stream = anstream::stdout().lock();
    match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Machine(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a note to standard error. When even that fails there is nobody left to tell.
pub fn note(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{}", safe(text));
}

/// Shows what was asked for in place of a command: help, the version, or what is wrong with the arguments.
pub fn help(help: &clap::Error) -> ExitCode {
    let text = help.render().ansi().to_string();
    if help.use_stderr() {
        note(text.trim_end());
    } else if let Err(failure) = print(&text) {
        return failure.exit_code();
    }
    u8::try_from(help.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from)
}

/// Writes a warning to standard error, on one line.
pub fn warn(text: &str) {
    note(&format!("{} {}", styled(NOTE, "warning:"), visible(text)));
}

/// Writes an error to standard error; a message that is laid out already is left as it is.
pub fn complain(message: &str) {
    let message = message.trim_end();
    if message.contains('\n') || message.contains('\u{1b}') || message.starts_with("error") {
        note(message);
    } else {
        note(&format!("{} {message}", styled(BAD, "error:")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_styles_reach_the_terminal() {
        let text = format!("{}\n", styled(BAD, "stalled"));
        assert_eq!(safe(&text), text);
        let cases = [
            ("\u{1b}]0;title\u{7}", "\\u001B]0;title\\u0007"),
            ("\u{1b}[8mhidden", "\\u001B[8mhidden"),
            ("\u{1b}[2J\u{9b}2J", "\\u001B[2J\\u009B2J"),
            ("\u{202e}txet\r", "\\u202Etxet\\u000D"),
            ("\u{1b}", "\\u001B"),
        ];
        for (text, shown) in cases {
            assert_eq!(safe(text), shown);
        }
    }

    #[test]
    fn a_long_text_loses_its_middle() {
        assert_eq!(shortened("short", 9), "short");
        assert_eq!(shortened("0123456789ab", 9), "01234…9ab");
        assert_eq!(title("two\nlines"), "two\\u000Alines");
        assert_eq!(title(""), "mechanism");
    }

    #[test]
    fn the_help_keeps_its_styles() {
        use clap::CommandFactory;
        let help = crate::arguments::Arguments::command().render_help().ansi().to_string();
        assert_eq!(safe(&help), help);
    }
}
