//! The log of this visit's panics and errors, for the page and its tests.
//!
//! In: log records and panics. Out: their messages in order, and their number. Thread-local, since
//! loggers and panic hooks are global.

use std::cell::RefCell;

use super::{page, scene_watch};

/// Messages kept; later ones are only counted.
const MAX_MESSAGES: usize = 32;

thread_local! {
    static ERROR_LOG: RefCell<ErrorLog> =
        const { RefCell::new(ErrorLog { messages: Vec::new(), count: 0 }) };
}

/// The panics and errors of this visit.
#[derive(Clone, Debug, Default)]
pub struct ErrorLog {
    /// The first messages, oldest first.
    pub messages: Vec<String>,
    /// The number of all errors.
    pub count: u32,
}

/// A copy of the log as of now.
pub fn snapshot() -> ErrorLog {
    ERROR_LOG.with(|log| log.borrow().clone())
}

/// Installs the logger and the panic hook; call it once, before anything can fail.
pub fn install() {
    let console = eframe::WebLogger::new(log::LevelFilter::Warn);
    if log::set_boxed_logger(Box::new(Logger { console })).is_ok() {
        log::set_max_level(log::LevelFilter::Warn);
    }
    let previous_hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        record_error(info.to_string());
        page::show_stop(&info.to_string());
        scene_watch::note_end();
        previous_hook(info);
    }));
}

fn record_error(message: String) {
    // A panic may hold the log: a second panic here would hide the first.
    let _ = ERROR_LOG.try_with(|log| {
        if let Ok(mut log) = log.try_borrow_mut() {
            log.count += 1;
            if log.messages.len() < MAX_MESSAGES {
                log.messages.push(message);
            }
        }
    });
}

/// Logs to the browser's console, and this crate's errors to the log as well.
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
            record_error(record.args().to_string());
        }
    }

    fn flush(&self) {}
}
