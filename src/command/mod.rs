//! What was asked for, and how its outcome is told.
//!
//! In: the arguments. Out: pictures, documents and facts on standard output or in files;
//! everything said to people on standard error; an exit code: 0 done, 1 failed, 2 wrong usage
//! or an invalid scene.
//!
//! | file | what lives there |
//! |---|---|
//! | [`render`] | `mandelight render`: a picture of a scene |
//! | [`frames`] | `mandelight frames`: the frames of a camera path |
//! | [`scene`] | `mandelight scene`: a document to start from |
//! | [`info`] | `mandelight info`: the GPU |
//! | [`input`] | a scene from a file, a pipe or a picture; `--set` |
//! | [`output`] | a file that is there whole or not at all |
//! | [`folder`] | a folder of frames that belong together |
//! | [`environment`] | an environment map |
//! | [`stereo`] | how both eyes' pictures are put together |
//! | [`adapter`] | which GPU |

mod adapter;
mod environment;
mod folder;
mod frames;
mod info;
mod input;
mod output;
mod render;
mod scene;
mod stereo;

use std::{
    fmt,
    io::{self, Write},
    process::ExitCode,
};

use clap::{Parser, Subcommand};

/// Draws 3D fractals without a window.
#[derive(Parser)]
#[command(name = "mandelight", version, about, long_about = None)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Renders a scene to a PNG that carries the scene
    Render(render::Arguments),
    /// Renders the frames of a scene's camera path to a folder of PNGs
    Frames(frames::Arguments),
    /// Prints a scene document, to edit or to pipe into `render -`
    Scene(scene::Arguments),
    /// Tells which GPU would be used, and which there are
    Info(info::Arguments),
}

/// Why a command ended without its result.
#[derive(Debug)]
enum Failure {
    /// Wrong arguments or an invalid scene: the same call can never succeed.
    Usage(String),
    /// The machine stood in the way.
    Failed(String),
}

impl Failure {
    fn usage(message: impl fmt::Display) -> Self {
        Self::Usage(message.to_string())
    }

    fn failed(message: impl fmt::Display) -> Self {
        Self::Failed(message.to_string())
    }

    fn report(&self) -> ExitCode {
        let (message, code) = match self {
            Self::Usage(message) => (message, 2),
            Self::Failed(message) => (message, 1),
        };
        tell(message);
        ExitCode::from(code)
    }
}

/// Runs the command that the arguments name. Wrong ones end the process here, with code 2.
pub fn run() -> ExitCode {
    log_errors();
    let outcome = match Arguments::parse().command {
        Command::Render(arguments) => render::run(arguments),
        Command::Frames(arguments) => frames::run(arguments),
        Command::Scene(arguments) => scene::run(arguments),
        Command::Info(arguments) => info::run(arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Says something to people.
fn tell(message: &str) {
    // Where standard error is gone there is nobody left to tell.
    let _ = writeln!(io::stderr(), "mandelight: {message}");
}

/// Writes a command's result. A reader that has seen enough and left is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Lets the library's warnings reach standard error.
fn log_errors() {
    struct Log;

    impl log::Log for Log {
        fn enabled(&self, metadata: &log::Metadata) -> bool {
            // wgpu reports to its caller whatever matters here.
            metadata.target().starts_with("mandelight")
        }

        fn log(&self, record: &log::Record) {
            if self.enabled(record.metadata()) {
                tell(&record.args().to_string());
            }
        }

        fn flush(&self) {}
    }

    // The only logger of this process, so none can be in its place already.
    let _ = log::set_logger(&Log);
    log::set_max_level(log::LevelFilter::Warn);
}
