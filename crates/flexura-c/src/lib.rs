//! `flexura.h` for programs in C.
//!
//! Every function that takes a pointer trusts it as the header says; nothing else is trusted, and no panic gets past.

use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{SampleStatus, Stepper};
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

const INPUT_ERROR: c_int = 7;
const BUG: c_int = 8;

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Notes why a call did not do what was asked.
fn tell(message: &str) {
    let text = CString::new(message.replace('\0', " ")).unwrap_or_default();
    MESSAGE.with(|kept| *kept.borrow_mut() = text);
}

fn code(status: &SampleStatus) -> c_int {
    match status {
        SampleStatus::Solved(Status::Converged) => 0,
        SampleStatus::Solved(Status::Stalled) => 1,
        SampleStatus::Solved(Status::IterationLimit) => 2,
        SampleStatus::Solved(Status::Singular) => 3,
        // No solve ends as infeasible, only a search among designs.
        SampleStatus::Solved(Status::Inconsistent | Status::Infeasible) => 4,
        SampleStatus::Solved(Status::AccuracyLimit) => 5,
        SampleStatus::Solved(Status::Interrupted) => 6,
        SampleStatus::InputError => INPUT_ERROR,
    }
}

/// Does something that may be a bug.
fn guarded(work: impl FnOnce() -> c_int) -> c_int {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        tell("something went wrong inside; this is a bug in flexura, please report it");
        BUG
    })
}

/// The version.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Why the last call of this thread did not do what was asked.
#[unsafe(no_mangle)]
pub extern "C" fn flexura_message() -> *const c_char {
    MESSAGE.with(|kept| kept.borrow().as_ptr())
}

/// # Safety
/// `list` points to `count` texts that end in zero.
unsafe fn names<'a>(list: *const *const c_char, count: usize) -> Result<Vec<&'a str>, String> {
    if count == 0 {
        return Ok(Vec::new());
    }
    if list.is_null() {
        return Err("names are missing".to_owned());
    }
    // SAFETY: the caller's promise.
    let list = unsafe { slice::from_raw_parts(list, count) };
    // SAFETY: the caller's promise.
    list.iter().map(|name| unsafe { text(*name) }).collect()
}

/// # Safety
/// `text` is null or points to a text that ends in zero.
unsafe fn text<'a>(text: *const c_char) -> Result<&'a str, String> {
    if text.is_null() {
        return Err("a text is missing".to_owned());
    }
    // SAFETY: the caller's promise.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|_| "a text is not UTF-8".to_owned())
}

/// Reads a model file and makes it ready.
///
/// # Safety
/// Pointers are as `flexura.h` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_open(
    file: *const c_char,
    inputs: *const *const c_char,
    input_count: usize,
    outputs: *const *const c_char,
    output_count: usize,
    tolerance: f64,
    stepper: *mut *mut Stepper,
) -> c_int {
    guarded(|| {
        if stepper.is_null() {
            tell("there is no place for the stepper");
            return INPUT_ERROR;
        }
        // SAFETY: the caller's promise.
        let made = unsafe {
            *stepper = std::ptr::null_mut();
            opened(text(file), names(inputs, input_count), names(outputs, output_count), tolerance)
        };
        match made {
            Ok(made) => {
                tell("");
                // SAFETY: it is not null, and the caller's promise.
                unsafe { *stepper = Box::into_raw(Box::new(made)) };
                0
            }
            Err(message) => {
                tell(&message);
                INPUT_ERROR
            }
        }
    })
}

fn opened(
    file: Result<&str, String>,
    inputs: Result<Vec<&str>, String>,
    outputs: Result<Vec<&str>, String>,
    tolerance: f64,
) -> Result<Stepper, String> {
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(format!("{tolerance} is no tolerance: a number between 0 and 1 is wanted"));
    }
    let file = Document::read(file?).map_err(|report| report.to_string())?;
    let model = file.model(&[]).map_err(|report| report.to_string())?;
    Stepper::new(&model, &inputs?, &outputs?, tolerance).map_err(|error| {
        let hint = Some(error.hint.as_str()).filter(|hint| !hint.is_empty());
        file.problem(&error.path, &error.message, hint).render(false)
    })
}

/// How many numbers go in.
///
/// # Safety
/// `stepper` is null or one that `flexura_open` gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_input_size(stepper: *const Stepper) -> usize {
    // SAFETY: the caller's promise.
    unsafe { stepper.as_ref() }.map_or(0, Stepper::inputs)
}

/// How many numbers come out.
///
/// # Safety
/// `stepper` is null or one that `flexura_open` gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_output_size(stepper: *const Stepper) -> usize {
    // SAFETY: the caller's promise.
    unsafe { stepper.as_ref() }.map_or(0, Stepper::outputs)
}

/// Goes to the equilibrium for these inputs and writes what comes out.
///
/// # Safety
/// `stepper` is one that `flexura_open` gave; `values` and `out` hold as many numbers as it says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_step(stepper: *mut Stepper, values: *const f64, out: *mut f64) -> c_int {
    guarded(|| {
        // SAFETY: the caller's promise.
        let Some(stepper) = (unsafe { stepper.as_mut() }) else {
            tell("there is no stepper");
            return INPUT_ERROR;
        };
        if values.is_null() || out.is_null() {
            tell("there are no numbers, or no place for them");
            return INPUT_ERROR;
        }
        // SAFETY: the caller's promise.
        let (values, out) = unsafe {
            let values = slice::from_raw_parts(values, stepper.inputs());
            (values, slice::from_raw_parts_mut(out, stepper.outputs()))
        };
        let status = stepper.step(values, out);
        match stepper.reason() {
            Some(reason) => tell(reason),
            None if status.is_converged() => MESSAGE.with(|kept| {
                // A text of its own costs an allocation.
                if !kept.borrow().is_empty() {
                    *kept.borrow_mut() = CString::default();
                }
            }),
            None => tell(status.word()),
        }
        code(&status)
    })
}

/// The next step begins at rest.
///
/// # Safety
/// `stepper` is null or one that `flexura_open` gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_reset(stepper: *mut Stepper) {
    // SAFETY: the caller's promise.
    if let Some(stepper) = unsafe { stepper.as_mut() } {
        stepper.reset();
    }
}

/// Ends a stepper.
///
/// # Safety
/// `stepper` is null or one that `flexura_open` gave, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn flexura_close(stepper: *mut Stepper) {
    if !stepper.is_null() {
        // SAFETY: the caller's promise.
        drop(unsafe { Box::from_raw(stepper) });
    }
}
