//! What went wrong in this visit: panics, GPU errors that nothing caught, and everything else that
//! the program calls an error. For the page and its tests.
//!
//! In: log records and panics. Out: their messages, in order, counted. Thread-local, since a logger
//! and a panic hook belong to nobody.

use std::cell::RefCell;

use super::page;

/// More messages than this are counted but not kept.
const MAX_KEPT: usize = 32;

thread_local! {
    static FAULTS: RefCell<Faults> = const { RefCell::new(Faults { messages: Vec::new(), count: 0 }) };
}

/// Everything that went wrong so far.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    /// The first messages, oldest first.
    pub messages: Vec<String>,
    /// How many there were.
    pub count: u32,
}

/// The faults so far.
pub fn so_far() -> Faults {
    FAULTS.with(|faults| faults.borrow().clone())
}

/// Sends warnings and errors to the console, and makes errors and panics faults. Once a visit,
/// before anything can go wrong.
pub fn watch() {
    let console = eframe::WebLogger::new(log::LevelFilter::Warn);
    if log::set_boxed_logger(Box::new(Logger { console })).is_ok() {
        log::set_max_level(log::LevelFilter::Warn);
    }
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        note(info.to_string());
        page::notice(
            "Mandelight stopped",
            &format!("It made a mistake; your scene is kept. Try again to go on.\n{info}"),
        );
        before(info);
    }));
}

fn note(message: String) {
    // Whatever state a panic left behind, noting it must not become a second one.
    let _ = FAULTS.try_with(|faults| {
        if let Ok(mut faults) = faults.try_borrow_mut() {
            faults.count += 1;
            if faults.messages.len() < MAX_KEPT {
                faults.messages.push(message);
            }
        }
    });
}

struct Logger {
    console: eframe::WebLogger,
}

impl log::Log for Logger {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        self.console.enabled(metadata)
    }

    fn log(&self, record: &log::Record<'_>) {
        self.console.log(record);
        let is_own = record.target().starts_with(env!("CARGO_PKG_NAME"));
        if is_own && record.level() == log::Level::Error {
            note(record.args().to_string());
        }
    }

    fn flush(&self) {}
}
