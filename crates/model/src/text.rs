//! Text that somebody else wrote, shown so that it cannot do anything: names, titles and lines of files may hold characters
//! that steer a terminal, turn the direction of writing, or break the format that they are written into.

use std::borrow::Cow;
use std::fmt::Write;

/// The text on one line, with every character that cannot be seen written as TOML writes it: `\u001B`, `\u202E`.
pub fn visible(text: &str) -> Cow<'_, str> {
    written(text, is_unseen)
}

/// The same of a text of several lines, whose line breaks and tabs stay.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    written(text, |character| is_unseen(character) && !matches!(character, '\n' | '\t'))
}

/// Does a character steer what shows it, or is it none at all? Control characters (C0, DEL, C1), marks of direction, separators
/// of lines, spaces without width, tags, and noncharacters. Joiners stay, which scripts and pictograms need.
pub fn is_unseen(character: char) -> bool {
    character.is_control()
        || u32::from(character) & 0xfffe == 0xfffe
        || matches!(character,
            '\u{61c}' | '\u{180e}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{fdd0}'..='\u{fdef}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e007f}')
}

fn written(text: &str, is_written: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_written) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        let code = u32::from(character);
        // Writing to a String cannot fail.
        let _ = match (is_written(character), code > 0xffff) {
            (false, _) => shown.write_char(character),
            (true, false) => write!(shown, "\\u{code:04X}"),
            (true, true) => write!(shown, "\\U{code:08X}"),
        };
    }
    Cow::Owned(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_written_out() {
        let cases = [
            ("plain ü → 𝛼 क्‍ष", "plain ü → 𝛼 क्‍ष"),
            ("\u{1b}[31mred", "\\u001B[31mred"),
            ("\u{9b}2J", "\\u009B2J"),
            ("abc\u{202e}fed", "abc\\u202Efed"),
            ("a\u{ffff}\u{fffe}b", "a\\uFFFF\\uFFFEb"),
            ("two\nlines\r", "two\\u000Alines\\u000D"),
            ("\u{1ffff}\u{e0041}", "\\U0001FFFF\\U000E0041"),
        ];
        for (text, shown) in cases {
            assert_eq!(visible(text), shown);
        }
        assert_eq!(visible_lines("a\tb\n\u{7f}"), "a\tb\n\\u007F");
    }
}
