//! `cargo xtask …`: builds, serves, tests and packs Mandelight.
//!
//! In: the command line. Out: the exit code, 0 when all went well, 1 when something failed, 2 for a
//! command line that makes no sense. Each command gets what it needs by itself (see `need.rs`).

mod bench;
mod check;
mod need;
mod page;
mod pictures;
mod serve;
mod shell;
mod test;

use std::process::ExitCode;

const HELP: &str = "\
Usage: cargo xtask <command>

  serve [--port N]  build the page and serve it on 127.0.0.1 (from port 8080 on)
  test              everything: check, the page, unit, GPU and browser tests
  dist              write dist/, a folder that any static host can serve
  check             formatting and lints, native and wasm32, warnings denied
  bless             make the golden pictures again from what the renderer draws now
  bench [OPTION…]   measure the renderer beside the thesis's algorithm; --help tells the options
  pictures [NAME…]  draw the pictures of the README and the docs again
  help              this text
";

/// What the command line asks for.
#[derive(Debug, PartialEq)]
enum Wish {
    Serve { port: u16 },
    Test,
    Dist,
    Check,
    Bless,
    Bench { options: Vec<String> },
    Pictures { names: Vec<String> },
    Help,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let wish = match wish_of(&words) {
        Ok(wish) => wish,
        Err(complaint) => {
            eprint!("{complaint}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    let result = match wish {
        Wish::Serve { port } => serve::serve(port),
        Wish::Test => test::test(),
        Wish::Dist => page::dist().map(drop),
        Wish::Check => check::check(),
        Wish::Bless => test::bless(),
        Wish::Bench { options } => bench::bench(&options),
        Wish::Pictures { names } => pictures::pictures(&names),
        Wish::Help => {
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

/// Reads the command line; the error is a sentence for the person who typed it.
fn wish_of(words: &[String]) -> Result<Wish, String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        [] | ["help" | "-h" | "--help", ..] => Ok(Wish::Help),
        ["serve"] => Ok(Wish::Serve { port: serve::FIRST_PORT }),
        ["serve", "--port", port] => port
            .parse()
            .map(|port| Wish::Serve { port })
            .map_err(|_| format!("--port wants a number from 0 to 65535, not {port:?}")),
        ["test"] => Ok(Wish::Test),
        ["dist"] => Ok(Wish::Dist),
        ["check"] => Ok(Wish::Check),
        ["bless"] => Ok(Wish::Bless),
        ["bench", options @ ..] => {
            Ok(Wish::Bench { options: options.iter().map(|&option| option.to_owned()).collect() })
        }
        ["pictures", names @ ..] => {
            Ok(Wish::Pictures { names: names.iter().map(|&name| name.to_owned()).collect() })
        }
        other => Err(format!("there is no `cargo xtask {}`", other.join(" "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Wish, String> {
        wish_of(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn commands_are_understood() {
        assert_eq!(parsed("serve"), Ok(Wish::Serve { port: 8080 }));
        assert_eq!(parsed("serve --port 9000"), Ok(Wish::Serve { port: 9000 }));
        assert_eq!(parsed("test"), Ok(Wish::Test));
        let options = vec!["--views".into(), "whole,filled".into()];
        assert_eq!(parsed("bench --views whole,filled"), Ok(Wish::Bench { options }));
        assert_eq!(parsed("pictures bloom"), Ok(Wish::Pictures { names: vec!["bloom".into()] }));
        assert_eq!(parsed(""), Ok(Wish::Help));
    }

    #[test]
    fn nonsense_is_named() {
        assert!(parsed("serve --port 70000").unwrap_err().contains("70000"));
        assert!(parsed("tset").unwrap_err().contains("tset"));
        assert!(parsed("dist now").unwrap_err().contains("dist now"));
    }
}
