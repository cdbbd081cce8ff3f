//! Arguments of the command line, which are parsed only.

use clap::Parser as _;
use mandelight::reading::visible_lines;

use crate::{
    FuzzTarget, InputFormat, Outcome,
    command::{CommandLine, explanation},
};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "command_line",
    check,
    seeds,
    format: InputFormat::Words,
    hundreds: 40,
    most_work: 4 << 20,
};

/// Most arguments of an input.
const MAX_ARGUMENTS: usize = 64;
/// Longest message beside what the message quotes, in bytes: the help of a command with every argument.
const MAX_HELP_BYTES: usize = 16 << 10;

/// Each line of the input is an argument.
fn check(bytes: &[u8]) -> Outcome {
    let text = String::from_utf8_lossy(bytes);
    let arguments = text.split('\n').take(MAX_ARGUMENTS);
    let Err(error) = CommandLine::try_parse_from(["mandelight"].into_iter().chain(arguments))
    else {
        return Outcome::Read;
    };
    let (code, message) = (error.exit_code(), explanation(&error));
    assert!(matches!(code, 0 | 2), "exit code {code}");
    assert_eq!(visible_lines(&message), message, "a message has control characters");
    // A control character takes up to eight letters.
    assert!(message.len() <= MAX_HELP_BYTES + 16 * bytes.len(), "a message is long");
    if code == 0 { Outcome::Read } else { Outcome::Refused }
}

fn seeds() -> Vec<Vec<u8>> {
    [
        "render\nscene.json\n-o\nout.png\n--size\n640x360\n--samples\n16\n--set\nfractal.power=3",
        "render\n-\n--output\nout.exr\n--stereo\npair\n--formula\nmandelbox\n--cut\n0,0,1,0.5\n--quiet",
        "render\nscene.json\n-o\nout.jpg\n--quality\n80\n--gradient\nember\n--adapter\n0\n--bits\n16",
        "frames\nscene.json\n-o\nframes\n--format\nwebp\n--set\npath.shutter=0.5\n--bounces\n3\n--noise\n0.01",
        "scene\n--preset\ncove\n--turntable\n6\n--look\nporcelain\n--set\ntone.exposure=1",
        "scene\n--surprise\n7",
        "formula\ncheck\nown.formula",
        "places\nscene.json\n--count\n3",
        "gallery\nfolder\n--name\nReefs",
        "formulas",
        "info",
        "--help",
        "render\n--help",
    ]
    .map(|text| text.as_bytes().to_vec())
    .into()
}
