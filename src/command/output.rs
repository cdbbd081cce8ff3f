//! Atomic writing of a file: the path has the old content until the new content is complete.
//!
//! In: a path. Out: a writer, whose bytes replace the path's content on commit.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, IsTerminal, Write},
    path::{Path, PathBuf},
    process,
    time::{SystemTime, UNIX_EPOCH},
};

/// The destination of a picture.
pub enum Output {
    /// A file with a temporary name in the folder of its final name.
    File(PartFile),
    /// Standard output, a device or a named pipe, which are written directly.
    Stream(Box<dyn Write>),
}

impl Output {
    /// Opens `path` for writing; `-` is standard output, which must not be a terminal.
    pub fn create(path: &Path) -> io::Result<Self> {
        if path == "-" {
            if io::stdout().is_terminal() {
                return Err(io::Error::other(
                    "a picture cannot be shown in a terminal; redirect the output to a file",
                ));
            }
            return Ok(Self::Stream(Box::new(io::stdout().lock())));
        }
        match fs::metadata(path) {
            Ok(existing) if existing.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            // A rename would replace a device such as /dev/null by a file.
            Ok(existing) if !existing.is_file() => {
                Ok(Self::Stream(Box::new(OpenOptions::new().write(true).open(path)?)))
            }
            // A rename to the canonical path keeps a symbolic link.
            Ok(_) => Ok(Self::File(PartFile::create(&fs::canonicalize(path)?)?)),
            Err(_) => Ok(Self::File(PartFile::create(path)?)),
        }
    }

    /// Gives the complete file its final name.
    pub fn commit(self) -> io::Result<()> {
        match self {
            Self::File(part) => part.commit(),
            Self::Stream(mut stream) => stream.flush(),
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

/// A file with a temporary name until it is committed. Dropping it earlier removes the file.
pub struct PartFile {
    file: BufWriter<File>,
    part_path: PathBuf,
    final_path: PathBuf,
}

impl PartFile {
    fn create(final_path: &Path) -> io::Result<Self> {
        let name = final_path.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
        // Process ids alone are not unique: they are reused, and machines may share a folder.
        let nanos = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |t| t.as_nanos());
        let part_name = format!(".{}.{}-{nanos:x}.part", name.to_string_lossy(), process::id());
        let part_path = final_path.with_file_name(part_name);
        // `create_new` does not follow a symbolic link that another user has placed here.
        let file = OpenOptions::new().write(true).create_new(true).open(&part_path)?;
        Ok(Self { file: BufWriter::new(file), part_path, final_path: final_path.to_owned() })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    #[test]
    fn a_file_appears_only_when_committed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.png");
        let mut output = Output::create(&path).unwrap();
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
        let mut output = Output::create(&path).unwrap();
        output.write_all(b"half").unwrap();
        drop(output);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names_in(folder.path()), ["out.png"]);
    }

    #[test]
    fn a_folder_and_a_missing_folder_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Output::create(folder.path()).is_err());
        assert!(Output::create(&folder.path().join("none/out.png")).is_err());
        assert!(Output::create(Path::new("")).is_err());
        assert!(names_in(folder.path()).is_empty());
    }
}
