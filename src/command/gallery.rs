//! `mandelight gallery`: the list of a folder's pictures, for a page that shows them.

use std::{
    fs::{self, File},
    io::{self, Read as _, Write as _},
    path::{Path, PathBuf},
    sync::Arc,
};

use mandelight::{
    reading::visible,
    scene::gallery::{Gallery, LIST_FILE, MAX_LIST_BYTES, is_in_folder},
};

use super::{Failure, input, message, output::Output, shown};

/// The arguments of `mandelight gallery`.
#[derive(clap::Args)]
pub struct GalleryArguments {
    /// The folder whose pictures to list; the list is its gallery.json
    folder: PathBuf,
    /// The gallery's name, which the page shows
    #[arg(long, default_value = "")]
    name: String,
}

/// Writes the list of the pictures in a folder that contain their scene, by name.
pub fn run(GalleryArguments { folder, name }: GalleryArguments) -> Result<(), Failure> {
    let failed = |path: &Path, error: &dyn std::fmt::Display| {
        Failure::failed(format!("{}: {error}", shown(path)))
    };
    let list = folder.join(LIST_FILE);
    check_replaceable(&list).map_err(|error| failed(&list, &error))?;
    let mut names = Vec::new();
    for entry in fs::read_dir(&folder).map_err(|error| failed(&folder, &error))? {
        let path = entry.map_err(|error| failed(&folder, &error))?.path();
        if !is_picture(&path) {
            continue;
        }
        let Some(file) = path.file_name().and_then(|name| name.to_str()) else { continue };
        if !is_in_folder(file) {
            let file = visible(file);
            message(&format!("left out: {file}: its name is too long, or has one of \\ : ? # %"));
            continue;
        }
        // Opening a pipe would wait for a writer.
        let reason = match fs::metadata(&path) {
            Ok(metadata) if metadata.is_file() => None,
            Ok(_) => Some("not a file".to_owned()),
            Err(error) => Some(error.to_string()),
        };
        if let Some(reason) = reason {
            message(&format!("left out: {}: {reason}", visible(file)));
            continue;
        }
        match input::read_project(&path) {
            Ok(_) => names.push(file.to_owned()),
            Err(Failure::Usage(reason) | Failure::Failed(reason)) => {
                message(&format!("left out: {reason}"));
            }
        }
    }
    names.sort();
    let count = names.len();
    let gallery = Gallery::new(&name, names).map_err(Failure::usage)?;
    // The list is a file, whose opening never waits.
    let interrupted = Arc::default();
    let write = || -> io::Result<()> {
        let mut output = Output::create(&list, &interrupted)?;
        output.write_all(gallery.to_json().as_bytes())?;
        output.commit()
    };
    write().map_err(|error| failed(&list, &error))?;
    message(&format!("{}: {count} pictures", shown(&list)));
    Ok(())
}

/// Refuses to replace a file of the list's name that is not a list.
fn check_replaceable(list: &Path) -> io::Result<()> {
    let is_file = match fs::metadata(list) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        metadata => metadata?.is_file(),
    };
    // Opening anything but a file might wait.
    if is_file {
        // One byte more than the limit, so that a longer file is no list.
        let mut bytes = Vec::new();
        File::open(list)?.take(MAX_LIST_BYTES as u64 + 1).read_to_end(&mut bytes)?;
        if str::from_utf8(&bytes).is_ok_and(|text| Gallery::from_json(text).is_ok()) {
            return Ok(());
        }
    }
    Err(io::Error::other("this file is not a gallery's list; it was not changed"))
}

/// True for the files that browsers show as pictures.
fn is_picture(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    matches!(ending.to_ascii_lowercase().as_str(), "png" | "jpg" | "jpeg" | "webp")
}
