//! A stream that is written by a thread of its own, so that waiting for its reader can be interrupted.

use std::{
    io::{self, Write},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver, RecvTimeoutError, SyncSender, TrySendError},
    },
    thread,
    time::Duration,
};

/// Most bytes of a piece.
pub const PIECE_BYTES: usize = 256 << 10;
/// Pieces that may wait for the reader.
const WAITING: usize = 4;
/// Time between two looks at whether the command is interrupted.
const LOOK: Duration = Duration::from_millis(10);

/// A stream whose sink is open.
pub struct Stream {
    pieces: SyncSender<Vec<u8>>,
    outcome: Receiver<io::Result<()>>,
    interrupted: Arc<AtomicBool>,
}

impl Stream {
    /// Opens a sink and waits until it is open, or until `interrupted` is set.
    ///
    /// The thread of an interrupted stream waits on; it ends with the process.
    pub fn open<W: Write>(
        interrupted: Arc<AtomicBool>,
        open: impl FnOnce() -> io::Result<W> + Send + 'static,
    ) -> io::Result<Self> {
        let (pieces, received) = mpsc::sync_channel::<Vec<u8>>(WAITING);
        let (report, outcome) = mpsc::channel();
        thread::spawn(move || {
            let write_all = || -> io::Result<()> {
                let mut sink = open()?;
                // Nobody listens any more where the stream is dropped.
                let _ = report.send(Ok(()));
                received.iter().try_for_each(|piece| sink.write_all(&piece))?;
                sink.flush()
            };
            let result = write_all();
            let _ = report.send(result);
        });
        let stream = Self { pieces, outcome, interrupted };
        stream.wait().map(|()| stream)
    }

    /// Waits until everything is written.
    pub fn finish(self) -> io::Result<()> {
        let Self { pieces, outcome, interrupted } = self;
        drop(pieces);
        wait(&outcome, &interrupted)
    }

    fn wait(&self) -> io::Result<()> {
        wait(&self.outcome, &self.interrupted)
    }
}

/// Waits for the thread's next report.
fn wait(outcome: &Receiver<io::Result<()>>, interrupted: &AtomicBool) -> io::Result<()> {
    loop {
        match outcome.recv_timeout(LOOK) {
            Ok(result) => return result,
            Err(RecvTimeoutError::Disconnected) => return Err(io::ErrorKind::BrokenPipe.into()),
            Err(RecvTimeoutError::Timeout) if interrupted.load(Ordering::Relaxed) => {
                return Err(interruption());
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}

/// Not of the kind `Interrupted`, after which `write_all` would try again.
fn interruption() -> io::Error {
    io::Error::other("interrupted")
}

impl Write for Stream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let bytes = &bytes[..bytes.len().min(PIECE_BYTES)];
        let mut piece = bytes.to_owned();
        loop {
            match self.pieces.try_send(piece) {
                Ok(()) => return Ok(bytes.len()),
                Err(TrySendError::Full(_)) if self.interrupted.load(Ordering::Relaxed) => {
                    return Err(interruption());
                }
                Err(TrySendError::Full(back)) => piece = back,
                // The thread has ended, and says why.
                Err(TrySendError::Disconnected(_)) => {
                    return self.wait().and(Err(io::ErrorKind::BrokenPipe.into()));
                }
            }
            thread::sleep(LOOK / 10);
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
