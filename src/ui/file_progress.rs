//! The file that is being fetched and decoded: one at a time, the newest.
//!
//! In: files as they are chosen. Out: a ticket for each, which is valid until a newer file is chosen, or a cancellation.
//! A file that arrives late can thus not replace a newer one.

/// Seconds after which the interface shows the file's name: most files take less.
pub const SHOWN_AFTER_SECS: f64 = 0.3;

/// What to do with a scene that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneUse {
    /// Show it at once.
    Open,
    /// Fly to it: a picture of the gallery.
    FlyInto,
}

/// A file that is being read.
pub struct FileInProgress {
    /// The file's name, without control characters.
    pub name: String,
    /// What to do with its scene.
    pub purpose: SceneUse,
    ticket: u32,
    since_secs: f64,
}

/// The newest file, until it is read.
#[derive(Default)]
pub struct FileProgress {
    file: Option<FileInProgress>,
    tickets: u32,
}

impl FileProgress {
    /// Registers a file of a visible name that was chosen at `now_secs`, in place of the one before. Returns its ticket.
    pub fn start(&mut self, name: String, purpose: SceneUse, now_secs: f64) -> u32 {
        self.tickets = self.tickets.wrapping_add(1);
        let ticket = self.tickets;
        self.file = Some(FileInProgress { name, purpose, ticket, since_secs: now_secs });
        ticket
    }

    /// Whether the file of `ticket` is the newest and neither read nor cancelled.
    pub fn is_current(&self, ticket: u32) -> bool {
        self.file.as_ref().is_some_and(|file| file.ticket == ticket)
    }

    /// Removes and returns the file of `ticket`; `None` if it is not current.
    pub fn finish(&mut self, ticket: u32) -> Option<FileInProgress> {
        self.file.take_if(|file| file.ticket == ticket)
    }

    /// Removes the file. Returns whether there was one.
    pub fn cancel(&mut self) -> bool {
        self.file.take().is_some()
    }

    /// The name of a file that takes long to read.
    pub fn slow_file(&self, now_secs: f64) -> Option<&str> {
        let file = self.file.as_ref()?;
        (now_secs - file.since_secs > SHOWN_AFTER_SECS).then_some(file.name.as_str())
    }

    /// Whether a file is being read.
    pub fn is_busy(&self) -> bool {
        self.file.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_late_file_does_not_replace_a_newer_one() {
        let mut progress = FileProgress::default();
        let clicked = progress.start("from the gallery.png".to_owned(), SceneUse::FlyInto, 0.0);
        let dropped = progress.start("dropped.json".to_owned(), SceneUse::Open, 1.0);
        assert!(!progress.is_current(clicked) && progress.is_current(dropped));
        assert!(progress.finish(clicked).is_none());
        let file = progress.finish(dropped).expect("the newest file");
        assert_eq!((file.name.as_str(), file.purpose), ("dropped.json", SceneUse::Open));
        // The download arrives after the newer file was read.
        assert!(!progress.is_current(clicked) && progress.finish(clicked).is_none());
    }

    #[test]
    fn a_cancelled_file_is_not_read() {
        let mut progress = FileProgress::default();
        let ticket = progress.start("a.json".to_owned(), SceneUse::Open, 0.0);
        assert_eq!(progress.slow_file(0.5 * SHOWN_AFTER_SECS), None);
        assert_eq!(progress.slow_file(2.0 * SHOWN_AFTER_SECS), Some("a.json"));
        assert!(progress.cancel() && !progress.is_busy() && !progress.cancel());
        assert!(progress.finish(ticket).is_none());
    }
}
