//! `cargo xtask …`: builds, serves, tests and packages Mandelight.
//!
//! In: the command line. Out: the exit code: 0 success, 1 failure, 2 an invalid command line. Each
//! command installs the tools that it needs (see `need.rs`).

mod bench;
mod check;
mod deny;
mod fuzz;
mod headers;
mod icons;
mod need;
mod notices;
mod page;
mod pictures;
mod serve;
mod shell;
mod test;
mod thumbnails;

use std::process::ExitCode;

const HELP: &str = "\
Usage: cargo xtask <command>

  serve [--port N]  build the page and serve it on 127.0.0.1 (first free port from 8080)
  test              run everything: check, the page, unit, GPU and browser tests
  test32            test the readers of files, links and texts with sizes of 32 bits,
                    as the page has; on Linux with an x86-64 processor
  dist              write dist/, a folder that any static host can serve
  check             check formatting, lints (native, wasm32, fuzzer), documentation and packages,
                    warnings denied
  advisories        check the packages' security advisories; needs the network
  nightly           run the tests that take long: 200 random views against fine marches,
                    2000 hostile scenes, 100,000 actions on the interface, and test32
                    with new inputs
  fuzz TARGET [MINUTES]
                    search for inputs that break a reader's promises; MINUTES is 10 unless given.
                    TARGET is a folder of fuzz/corpus, or all: each in turn, for an equal share
  bless             replace the golden pictures by the renderer's current output
  bench [OPTION…]   compare the renderer's speed with the thesis's algorithm; --help lists options
  notices           write THIRD-PARTY-LICENSES.txt anew, after a change of packages
  pictures [NAME…]  render the pictures of the README and the docs again
  thumbnails [NAME…]
                    render the small pictures on the buttons of scenes and dives again,
                    and the page's opening picture (\"opening\") and icons (\"icons\")
  help              print this text
";

/// A parsed command line.
#[derive(Debug, PartialEq)]
enum Command {
    Serve { port: u16 },
    Test,
    Test32,
    Dist,
    Check,
    Advisories,
    Nightly,
    Notices,
    Bless,
    Fuzz { target: String, minutes: u64 },
    Bench { options: Vec<String> },
    Pictures { names: Vec<String> },
    Thumbnails { names: Vec<String> },
    Help,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let command = match parse(&words) {
        Ok(command) => command,
        Err(message) => {
            eprint!("{message}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    let result = match command {
        Command::Serve { port } => serve::serve(port),
        Command::Test => test::test(),
        Command::Test32 => test::test32(),
        Command::Dist => page::dist().map(drop),
        Command::Check => check::check(),
        Command::Advisories => deny::advisories(),
        Command::Nightly => test::nightly(),
        Command::Notices => notices::write(),
        Command::Bless => test::bless(),
        Command::Fuzz { target, minutes } => fuzz::fuzz(&target, minutes),
        Command::Bench { options } => bench::bench(&options),
        Command::Pictures { names } => pictures::pictures(&names),
        Command::Thumbnails { names } => thumbnails::thumbnails(&names),
        Command::Help => {
            print!("{HELP}");
            Ok(())
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Parses the command line; the error is a message for the user.
fn parse(words: &[String]) -> Result<Command, String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        [] | ["help" | "-h" | "--help", ..] => Ok(Command::Help),
        ["serve"] => Ok(Command::Serve { port: serve::FIRST_PORT }),
        ["serve", "--port", port] => port
            .parse()
            .map(|port| Command::Serve { port })
            .map_err(|_| format!("--port must be a number from 0 to 65535, not {port:?}")),
        ["test"] => Ok(Command::Test),
        ["test32"] => Ok(Command::Test32),
        ["dist"] => Ok(Command::Dist),
        ["check"] => Ok(Command::Check),
        ["advisories"] => Ok(Command::Advisories),
        ["nightly"] => Ok(Command::Nightly),
        ["notices"] => Ok(Command::Notices),
        ["bless"] => Ok(Command::Bless),
        ["fuzz", target] => {
            Ok(Command::Fuzz { target: (*target).to_owned(), minutes: fuzz::MINUTES })
        }
        ["fuzz", target, minutes] => minutes
            .parse()
            .map(|minutes| Command::Fuzz { target: (*target).to_owned(), minutes })
            .map_err(|_| format!("the minutes must be a whole number, not {minutes:?}")),
        ["bench", options @ ..] => Ok(Command::Bench {
            options: options.iter().map(|&option| option.to_owned()).collect(),
        }),
        ["pictures", names @ ..] => {
            Ok(Command::Pictures { names: names.iter().map(|&name| name.to_owned()).collect() })
        }
        ["thumbnails", names @ ..] => {
            Ok(Command::Thumbnails { names: names.iter().map(|&name| name.to_owned()).collect() })
        }
        other => Err(format!("unknown command `cargo xtask {}`", other.join(" "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Command, String> {
        parse(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn commands_are_parsed() {
        assert_eq!(parsed("serve"), Ok(Command::Serve { port: 8080 }));
        assert_eq!(parsed("serve --port 9000"), Ok(Command::Serve { port: 9000 }));
        assert_eq!(parsed("test"), Ok(Command::Test));
        assert_eq!(parsed("test32"), Ok(Command::Test32));
        assert_eq!(parsed("advisories"), Ok(Command::Advisories));
        let options = vec!["--views".into(), "whole,filled".into()];
        assert_eq!(parsed("bench --views whole,filled"), Ok(Command::Bench { options }));
        assert_eq!(parsed("pictures bloom"), Ok(Command::Pictures { names: vec!["bloom".into()] }));
        let fuzz = |minutes| Ok(Command::Fuzz { target: "link".into(), minutes });
        assert_eq!((parsed("fuzz link"), parsed("fuzz link 90")), (fuzz(10), fuzz(90)));
        assert_eq!(parsed("thumbnails"), Ok(Command::Thumbnails { names: Vec::new() }));
        assert_eq!(parsed(""), Ok(Command::Help));
    }

    #[test]
    fn errors_name_the_invalid_argument() {
        assert!(parsed("serve --port 70000").unwrap_err().contains("70000"));
        assert!(parsed("fuzz link long").unwrap_err().contains("long"));
        assert!(parsed("tset").unwrap_err().contains("tset"));
        assert!(parsed("dist now").unwrap_err().contains("dist now"));
    }
}
