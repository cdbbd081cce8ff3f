//! The command line's commands: argument parsing, messages and exit codes.
//!
//! In: the arguments. Out: results on standard output or in files, messages for the user on
//! standard error, and an exit code: 0 success, 1 failure, 2 wrong usage or an invalid scene.
//!
//! | file | contents |
//! |---|---|
//! | [`render`] | `mandelight render`: a picture of a scene |
//! | [`frames`] | `mandelight frames`: the frames of a camera path |
//! | [`scene`] | `mandelight scene`: a document to start from |
//! | [`encoding`] | `--quality`, `--bits`, `--transparent`; `--format` |
//! | [`fractals`] | `--formula`, `--hybrid` and `--cut` |
//! | [`gradient`] | `--gradient`, `--second-gradient` |
//! | [`integrator`] | `--integrator`, `--bounces`, `--noise` |
//! | [`formulas`] | `mandelight formulas`, `mandelight formula check`: formulas and their texts |
//! | [`places`] | `mandelight places`: scenes at good places of a view |
//! | [`gallery`] | `mandelight gallery`: the list of a folder's pictures |
//! | [`info`] | `mandelight info`: the GPU |
//! | [`licenses`] | `mandelight --licenses`: the licences of what the program contains |
//! | [`input`] | a scene from a file, a pipe or a picture; `--set` |
//! | [`output`] | atomic writing of a file |
//! | [`stream`] | writing to a pipe that may wait |
//! | [`folder`] | a folder that is bound to one sequence of frames |
//! | [`kept`] | the check of a frame that is there |
//! | [`environment`] | `--environment`: an environment map |
//! | [`stereo`] | `--stereo`: the layout of both eyes' pictures |
//! | [`adapter`] | `--adapter`: the choice of a GPU |

mod adapter;
mod encoding;
mod environment;
mod folder;
mod formulas;
mod fractals;
mod frames;
mod gallery;
mod gradient;
mod info;
mod input;
mod integrator;
mod kept;
mod licenses;
mod look;
mod output;
mod places;
mod render;
pub mod scene;
mod stereo;
mod stream;

use std::{
    borrow::Cow,
    env,
    ffi::OsString,
    fmt,
    io::{self, Write},
    path::Path,
    process::{self, ExitCode},
};

use clap::{Parser, Subcommand};
use mandelight::reading::{visible, visible_lines};

/// Draws 3D fractals without a window.
#[derive(Parser)]
#[command(name = "mandelight", version, about, long_about = None, arg_required_else_help = true)]
#[command(args_conflicts_with_subcommands = true)]
pub struct CommandLine {
    /// Prints the licences of the software and fonts that this program contains
    #[arg(long)]
    licenses: bool,
    /// What to do; none with `licenses` alone.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// A command with its arguments.
#[derive(Subcommand)]
pub enum Command {
    /// Renders a scene to a PNG that carries the scene
    Render(render::RenderArguments),
    /// Renders the frames of a scene's camera path to a folder of PNGs
    Frames(frames::FramesArguments),
    /// Prints a scene document, to edit or to pipe into `render -`
    Scene(scene::SceneArguments),
    /// Lists the formulas
    Formulas(formulas::FormulasArguments),
    /// Checks the text of a formula
    Formula(formulas::FormulaArguments),
    /// Prints scenes at the places of a view that stay beautiful at every depth
    Places(places::PlacesArguments),
    /// Lists the pictures of a folder, so that a page shows the folder as a gallery
    Gallery(gallery::GalleryArguments),
    /// Prints the GPU that would be used, its limits, and the other GPUs
    Info(info::InfoArguments),
}

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// Wrong arguments or an invalid scene: exit code 2. The same call can never succeed.
    Usage(String),
    /// A failure of the machine, such as a full disk or a lost GPU: exit code 1.
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
        let (text, code) = match self {
            Self::Usage(text) => (text, 2),
            Self::Failed(text) => (text, 1),
        };
        message(text);
        ExitCode::from(code)
    }
}

/// Runs the command that the arguments name. Wrong arguments end the process with code 2.
pub fn run() -> ExitCode {
    log_errors();
    let command_line = CommandLine::try_parse().unwrap_or_else(|error| explain(&error));
    let Some(command) = command_line.command else {
        // Without any argument clap prints the help.
        debug_assert!(command_line.licenses, "the only argument beside the commands");
        return code_of(licenses::run());
    };
    let outcome = match command {
        Command::Render(arguments) => render::run(arguments),
        Command::Frames(arguments) => frames::run(arguments),
        Command::Scene(arguments) => scene::run(&arguments),
        Command::Formulas(arguments) => formulas::list(arguments),
        Command::Formula(arguments) => formulas::run(arguments),
        Command::Places(arguments) => places::run(arguments),
        Command::Gallery(arguments) => gallery::run(arguments),
        Command::Info(arguments) => info::run(arguments),
    };
    code_of(outcome)
}

/// The exit code of an outcome; says why a command failed.
fn code_of(outcome: Result<(), Failure>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Ends the process with the help that the arguments ask for, or with what is wrong with them.
fn explain(error: &clap::Error) -> ! {
    let is_plain =
        |argument: OsString| matches!(visible(&argument.to_string_lossy()), Cow::Borrowed(_));
    if env::args_os().all(is_plain) {
        error.exit();
    }
    // The message quotes arguments, whose lines could pass for messages, and colours are control characters.
    let shown = env::args_os().map(|argument| visible(&argument.to_string_lossy()).into_owned());
    let text = match CommandLine::try_parse_from(shown) {
        Err(error) => explanation(&error),
        Ok(_) => format!("{}\n", visible(&error.render().to_string())),
    };
    let _ = write!(io::stderr(), "{text}");
    process::exit(error.exit_code());
}

/// The text of an error without control characters.
pub fn explanation(error: &clap::Error) -> String {
    visible_lines(&error.render().to_string()).into_owned()
}

/// Writes a message for the user to standard error, without control characters.
///
/// Lines stay lines, so whoever quotes a file, a name or an argument makes it [`visible`].
fn message(text: &str) {
    // If standard error is closed, no user can read the message.
    let _ = writeln!(io::stderr(), "mandelight: {}", visible_lines(text));
}

/// A path as it is shown, on one line.
fn shown(path: &Path) -> String {
    visible(&path.to_string_lossy()).into_owned()
}

/// Writes a command's result to standard output. A closed pipe is not a failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Sends the library's warnings to standard error.
fn log_errors() {
    struct Log;

    impl log::Log for Log {
        fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
            // wgpu returns its relevant errors to the caller.
            metadata.target().starts_with("mandelight")
        }

        fn log(&self, record: &log::Record<'_>) {
            if self.enabled(record.metadata()) {
                message(&record.args().to_string());
            }
        }

        fn flush(&self) {}
    }

    // No other code of this process sets a logger, so this cannot fail.
    let _ = log::set_logger(&Log);
    log::set_max_level(log::LevelFilter::Warn);
}
