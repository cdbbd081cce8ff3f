//! Writing of a picture: to a file that appears when it is complete, or to a stream.
//!
//! In: a path. Out: a writer, whose bytes replace the path's content on commit.

use std::{
    collections::BTreeSet,
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, IsTerminal, Write},
    path::{Path, PathBuf},
    process,
    sync::{Arc, Mutex, PoisonError, atomic::AtomicBool},
    time::{SystemTime, UNIX_EPOCH},
};

use super::stream::{PIECE_BYTES, Stream};

/// Prefix and suffix of temporary names. Their length does not depend on the final name.
const PART_NAME: (&str, &str) = (".mandelight-", ".part");
/// Most symbolic links that follow each other, as Linux has it.
const MAX_LINKS: usize = 40;

/// The destination of a picture.
pub enum Output {
    /// A file with a temporary name in the folder of its final name.
    File(PartFile),
    /// Standard output, a device or a named pipe, which are written directly.
    Stream(BufWriter<Stream>),
}

impl Output {
    /// Opens `path` for writing; `-` is standard output, which must not be a terminal.
    ///
    /// Opening or writing a pipe that nobody reads fails when `interrupted` is set.
    pub fn create(path: &Path, interrupted: &Arc<AtomicBool>) -> io::Result<Self> {
        if path == "-" {
            if io::stdout().is_terminal() {
                return Err(io::Error::other(
                    "a picture cannot be shown in a terminal; redirect the output to a file",
                ));
            }
            let stream = Stream::open(interrupted.clone(), || Ok(io::stdout()))?;
            return Ok(Self::Stream(BufWriter::with_capacity(PIECE_BYTES, stream)));
        }
        match fs::metadata(path) {
            Ok(existing) if existing.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            // A rename would replace a device such as /dev/null by a file.
            Ok(existing) if !existing.is_file() => {
                let path = path.to_owned();
                let open = move || OpenOptions::new().write(true).open(path);
                let stream = Stream::open(interrupted.clone(), open)?;
                Ok(Self::Stream(BufWriter::with_capacity(PIECE_BYTES, stream)))
            }
            // A rename would replace a symbolic link, so the file that the link names is written.
            Ok(_) => Ok(Self::File(PartFile::create(&fs::canonicalize(path)?)?)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Ok(Self::File(PartFile::create(&target_of(path)?)?))
            }
            Err(error) => Err(error),
        }
    }

    /// Gives the complete file its final name.
    pub fn commit(self) -> io::Result<()> {
        match self {
            Self::File(part) => part.commit(),
            Self::Stream(stream) => {
                stream.into_inner().map_err(io::IntoInnerError::into_error)?.finish()
            }
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(part) => part.file.write(bytes),
            Self::Stream(stream) => stream.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(part) => part.file.flush(),
            Self::Stream(stream) => stream.flush(),
        }
    }
}

/// The path at the end of a chain of symbolic links, which need not exist.
fn target_of(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&path) {
            // An absolute target replaces the whole path.
            Ok(target) => path = path.with_file_name("").join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("these symbolic links have no end"))
}

/// A file with a temporary name until it is committed. Dropping it earlier removes the file.
pub struct PartFile {
    file: BufWriter<File>,
    part_path: PathBuf,
    final_path: PathBuf,
}

impl PartFile {
    fn create(final_path: &Path) -> io::Result<Self> {
        if final_path.file_name().is_none() {
            return Err(io::ErrorKind::InvalidFilename.into());
        }
        remove_stale_once(&final_path.with_file_name(""));
        loop {
            // Process ids alone are not unique: they are reused, and machines may share a folder.
            let nanos = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |t| t.as_nanos());
            let (prefix, suffix) = PART_NAME;
            let name = format!("{prefix}{:x}-{nanos:x}{suffix}", process::id());
            let part_path = final_path.with_file_name(name);
            // `create_new` does not follow a symbolic link that another user has placed here.
            let file = match OpenOptions::new().write(true).create_new(true).open(&part_path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                file => file?,
            };
            // The lock says that the file's process lives. Another process may have locked and removed the
            // file in between; where a file system has no locks, nobody removes it.
            let _ = file.try_lock();
            if part_path.exists() {
                let final_path = final_path.to_owned();
                return Ok(Self { file: BufWriter::new(file), part_path, final_path });
            }
        }
    }

    fn commit(mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_all()?;
        fs::rename(&self.part_path, &self.final_path)
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        // After a commit the temporary name does not exist, so the error is ignored.
        let _ = fs::remove_file(&self.part_path);
    }
}

/// Removes the temporary files of processes that were killed, the first time that this is called for `folder`.
pub fn remove_stale_once(folder: &Path) {
    static SEEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let is_new = SEEN.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned());
    if is_new {
        remove_stale(if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    }
}

/// Removes the temporary files that no living process has locked. What cannot be removed stays.
fn remove_stale(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_part = name.starts_with(PART_NAME.0) && name.ends_with(PART_NAME.1);
        // Opening anything but a file might wait, or follow a link.
        if is_part
            && entry.file_type().is_ok_and(|kind| kind.is_file())
            && let Ok(file) = File::open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{sync::atomic::Ordering, thread, time::Duration};

    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    fn create(path: &Path) -> io::Result<Output> {
        Output::create(path, &Arc::default())
    }

    fn write(path: &Path) {
        let mut output = create(path).unwrap();
        output.write_all(b"new").unwrap();
        output.commit().unwrap();
    }

    #[test]
    fn a_file_appears_only_when_committed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.png");
        let mut output = create(&path).unwrap();
        output.write_all(b"new").unwrap();
        output.flush().unwrap();
        assert!(!path.exists());
        output.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names_in(folder.path()), ["out.png"]);
    }

    #[test]
    fn an_uncommitted_file_leaves_the_old_content() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.png");
        fs::write(&path, b"old").unwrap();
        let mut output = create(&path).unwrap();
        output.write_all(b"half").unwrap();
        drop(output);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names_in(folder.path()), ["out.png"]);
    }

    #[test]
    fn a_folder_and_a_missing_folder_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        assert!(create(folder.path()).is_err());
        assert!(create(&folder.path().join("none/out.png")).is_err());
        assert!(create(Path::new("")).is_err());
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn names_may_be_as_long_as_the_file_system_has_them() {
        let folder = tempfile::tempdir().unwrap();
        for length in [249, 255] {
            write(&folder.path().join("x".repeat(length)));
        }
        // Before anything is rendered for it.
        assert!(create(&folder.path().join("x".repeat(256))).is_err());
        assert_eq!(names_in(folder.path()).len(), 2);
    }

    #[test]
    fn symbolic_links_are_followed_and_stay() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        // Without links on this system there is nothing to follow.
        let link = |target: &Path, name: &str| {
            let made = process::Command::new("ln").arg("-s").arg(target).arg(at(name)).status();
            made.is_ok_and(|status| status.success())
        };
        fs::create_dir(at("sub")).unwrap();
        if !link(Path::new("sub/second"), "first") {
            return;
        }
        link(Path::new("../file.png"), "sub/second");
        link(&at("absolute.png"), "to_absolute");
        for round in 0..2 {
            write(&at("first"));
            write(&at("to_absolute"));
            for link in ["first", "sub/second", "to_absolute"] {
                assert!(at(link).is_symlink(), "{link}, {round}");
            }
            assert_eq!(fs::read(at("file.png")).unwrap(), b"new");
            assert_eq!(fs::read(at("absolute.png")).unwrap(), b"new");
        }
        link(Path::new("circle"), "circle");
        assert!(create(&at("circle")).is_err());
        link(Path::new("none/file"), "nowhere");
        assert!(create(&at("nowhere")).is_err());
    }

    #[test]
    fn parts_of_killed_processes_are_removed_and_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let stale = at(".mandelight-1-2.part");
        fs::write(&stale, b"half").unwrap();
        fs::write(at(".other-1-2.part"), b"not ours").unwrap();
        fs::create_dir(at(".mandelight-folder.part")).unwrap();
        let output = create(&at("a.png")).unwrap();
        assert!(!stale.exists());
        remove_stale(folder.path());
        let mut names = names_in(folder.path());
        names.sort();
        assert_eq!(names.len(), 3, "{names:?}");
        output.commit().unwrap();
        assert!(at("a.png").exists());
    }

    /// Makes a named pipe; `None` where the system has none.
    fn pipe(path: &Path) -> Option<()> {
        let made = process::Command::new("mkfifo").arg(path).status();
        made.is_ok_and(|status| status.success()).then_some(())
    }

    #[test]
    fn a_pipe_that_nobody_opens_or_reads_can_be_interrupted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipe");
        let Some(()) = pipe(&path) else { return };
        let interrupt = || {
            let interrupted = Arc::new(AtomicBool::new(false));
            let set = interrupted.clone();
            thread::spawn(move || {
                thread::sleep(Duration::from_millis(200));
                set.store(true, Ordering::Relaxed);
            });
            interrupted
        };
        let error = Output::create(&path, &interrupt()).err().expect("interrupted");
        assert_eq!(error.to_string(), "interrupted");

        // This reader opens the pipe and reads nothing.
        let path = folder.path().join("second");
        let Some(()) = pipe(&path) else { return };
        let reader = OpenOptions::new().read(true).write(true).open(&path).unwrap();
        let mut output = Output::create(&path, &interrupt()).unwrap();
        let error = output.write_all(&[7; 4 << 20]).expect_err("interrupted");
        assert_eq!(error.to_string(), "interrupted");
        drop(reader);
    }

    #[test]
    fn a_pipe_gets_all_bytes() {
        use std::io::Read as _;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipe");
        let Some(()) = pipe(&path) else { return };
        let reader = {
            let path = path.clone();
            thread::spawn(move || {
                let mut bytes = Vec::new();
                File::open(path).unwrap().read_to_end(&mut bytes).unwrap();
                bytes
            })
        };
        let sent: Vec<u8> = (0..1_000_000_u32).map(|i| (i % 251) as u8).collect();
        let mut output = create(&path).unwrap();
        for part in sent.chunks(777) {
            output.write_all(part).unwrap();
        }
        output.commit().unwrap();
        assert!(reader.join().unwrap() == sent);
    }
}
