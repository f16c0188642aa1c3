//! The door to the page: bytes in and out of a WebAssembly module's memory.
//!
//! The page asks for room ([`flexura_room`]), puts its request there, calls [`flexura_answer`], and reads so many bytes as
//! [`flexura_length`] says from where [`flexura_text`] says. One request at a time.

use crate::Live;
use std::cell::RefCell;

thread_local! {
    static LIVE: RefCell<Live> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Room for a request of so many bytes; it stays valid until the next call of this function.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_room(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Does what the bytes in the room ask for. Zero where they are no text.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_answer() -> u32 {
    std::panic::set_hook(Box::new(|what| {
        TEXT.with(|text| {
            if let Ok(mut text) = text.try_borrow_mut() {
                *text = what.to_string();
            }
        })
    }));
    let request = REQUEST.with_borrow(|request| String::from_utf8(request.clone()));
    let Ok(request) = request else { return 0 };
    let answer = LIVE.with_borrow_mut(|live| live.answer(&request));
    TEXT.with_borrow_mut(|text| *text = answer);
    1
}

/// Where the last answer stands, or, after the module broke off, what it had to say.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_text() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}

/// How many bytes that is.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_length() -> usize {
    TEXT.with_borrow(String::len)
}
