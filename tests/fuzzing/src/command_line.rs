//! Arguments of the command line: all are parsed, and what `mandelight scene` prints is read.

use std::collections::BTreeSet;

use clap::{CommandFactory as _, Parser as _};
use mandelight::{
    reading::{visible, visible_lines},
    scene::document,
};

use crate::{
    FuzzTarget, InputFormat, Outcome,
    command::{Command, CommandLine, Failure, explanation, scene},
    promises::project_holds,
};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "command_line",
    check,
    seeds,
    format: InputFormat::Arguments,
    hundreds: 40,
    most_work: 32 << 20,
};

/// Most arguments of an input.
const MAX_ARGUMENTS: usize = 64;
/// Longest message beside what the message quotes, in bytes: the help of a command with every argument.
const MAX_HELP_BYTES: usize = 16 << 10;

/// Arguments of commands that are not run: a file is opened, or scenes are searched for.
const NOT_RUN: [&str; 4] = ["--formula", "--gradient", "--second-gradient", "--surprise"];

/// Each line of the input is an argument. `mandelight scene` is run too.
fn check(bytes: &[u8]) -> Outcome {
    let text = String::from_utf8_lossy(bytes);
    let arguments: Vec<&str> = text.split('\n').take(MAX_ARGUMENTS).collect();
    let is_not_run = |argument: &&str| NOT_RUN.iter().any(|name| argument.starts_with(name));
    match CommandLine::try_parse_from(["mandelight"].iter().chain(&arguments)) {
        Ok(CommandLine { command: Some(Command::Scene(scene)), .. })
            if !arguments.iter().any(is_not_run) =>
        {
            printed(scene::text(&scene), bytes.len())
        }
        Ok(_) => Outcome::Read,
        Err(error) => {
            let (code, message) = (error.exit_code(), explanation(&error));
            assert!(matches!(code, 0 | 2), "exit code {code}");
            is_message(&message, bytes.len());
            if code == 0 { Outcome::Read } else { Outcome::Refused }
        }
    }
}

/// What `mandelight scene` prints: a valid document, or a list; else what is wrong with the arguments.
fn printed(text: Result<String, Failure>, input_bytes: usize) -> Outcome {
    match text {
        Ok(text) => {
            if text.starts_with('{') {
                let project = document::project_from_json(&text).expect("a valid document");
                project_holds(&project);
            }
            Outcome::Read
        }
        Err(Failure::Usage(message)) => {
            assert_eq!(visible(&message), message, "a message has control characters");
            is_message(&message, input_bytes);
            Outcome::Refused
        }
        Err(Failure::Failed(message)) => panic!("no file and no GPU is used: {message}"),
    }
}

/// Checks a message about arguments of `input_bytes`.
fn is_message(message: &str, input_bytes: usize) {
    assert!(!message.is_empty(), "an error without a message");
    assert_eq!(visible_lines(message), message, "a message has control characters");
    // A control character takes up to eight letters.
    assert!(message.len() <= MAX_HELP_BYTES + 16 * input_bytes, "a message is long");
}

/// Every long argument of every command, such as `--size`.
pub fn long_arguments() -> BTreeSet<String> {
    fn of(command: &clap::Command) -> Vec<String> {
        let own = command.get_arguments().filter_map(|argument| argument.get_long());
        let own = own.map(|name| format!("--{name}"));
        own.chain(command.get_subcommands().flat_map(of)).collect()
    }
    of(&CommandLine::command()).into_iter().collect()
}

fn seeds() -> Vec<Vec<u8>> {
    [
        "render\nscene.json\n-o\nout.png\n--size\n640x360\n--samples\n16\n--set\nfractal.power=3",
        "render\n-\n--output\nout.exr\n--stereo\npair\n--formula\nmandelbox\n--cut\n0,0,1,0.5\n--quiet",
        "render\nscene.json\n-o\nout.jpg\n--quality\n80\n--gradient\nember\n--adapter\n0\n--bits\n16",
        "frames\nscene.json\n-o\nframes\n--format\nwebp\n--set\npath.shutter=0.5\n--bounces\n3\n--noise\n0.01",
        "scene\n--preset\ncove\n--turntable\n6\n--look\nporcelain\n--set\ntone.exposure=1",
        "scene\n--surprise\n7",
        "scene\n--list-looks",
        "scene\n--list-presets",
        "scene\n--hybrid\nrotate,mandelbox*2,mandelbulb\n--cut\nz=0.2,-y=0\n--look\nember\n--look\ntone/film",
        "scene\n--set\nlights.environment[0].intensity=2\n--set\nbackground.top=[0,0.5,1]\n--set\nbailout=4",
        "scene\n--set\nfractal.formula=mandelbox\n--set\nscale=-1.5\n--set\ncamera.position[2]=1e-20",
        "render\nscene.json\n-o\nout.png\n--environment\nsky.hdr\n--environment-lights\n32\n--integrator\npath\n--denoise",
        "render\nscene.json\n-o\nout.png\n--transparent\n--firefly-limit\n8\n--second-gradient\nice",
        "frames\nscene.json\n-o\nframes\n--frames\n3..9\n--exr",
        "--licenses",
        "formula\ncheck\nown.formula",
        "places\nscene.json\n--count\n3\n--depth\n1e-6\n--aspect\n1.6",
        "gallery\nfolder\n--name\nReefs",
        "formulas",
        "info\n--json",
        "--help",
        "render\n--help",
    ]
    .map(|text| text.as_bytes().to_vec())
    .into()
}
