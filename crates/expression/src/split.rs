//! Several expressions in one text.

use std::ops::Range;

/// The byte ranges of a text's parts between separators that stand in no bracket, so that `A:B` may hold `max(1, 2)`.
pub fn split(text: &str, separator: char) -> Vec<Range<usize>> {
    let (mut parts, mut depth, mut start) = (Vec::new(), 0i32, 0);
    for (i, character) in text.char_indices() {
        match character {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            c if c == separator && depth == 0 => {
                parts.push(start..i);
                start = i + c.len_utf8();
            }
            _ => {}
        }
    }
    parts.push(start..text.len());
    parts
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn separators_in_brackets_split_nothing() {
        let parts = |text: &'static str| -> Vec<&str> {
            split(text, ':').into_iter().map(|part| &text[part]).collect()
        };
        assert_eq!(parts("1 N : f(2:3)[4:5]:"), ["1 N ", " f(2:3)[4:5]", ""]);
        assert_eq!(parts(""), [""]);
    }
}
