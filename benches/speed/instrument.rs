//! Instrumented shaders: a module's text with counters.
//!
//! In: a module's files and [`Marks`]. Out: a second text; the program's own kernels stay as
//! they are. Each orbit step and each distance estimate increments a counter of its thread, and
//! each thread adds its counters to a buffer at its end. `tests/gpu/benchmark.rs` compares the counts
//! with orbits in f64.

/// One file of a module: its path and its text.
pub type File<'a> = (&'a str, &'a str);

/// What counts as an orbit step and as an estimate in a module.
pub struct Marks<'a> {
    /// Path prefix of the files whose innermost loops are orbits.
    pub orbits_in: &'a str,
    /// Functions in those files whose loops are not orbits.
    pub other_loops: &'a [&'a str],
    /// Functions whose calls count as an orbit step at their end; texts may lack them.
    pub steps: &'a [&'a str],
    /// Functions whose calls count as a distance estimate.
    pub estimates: &'a [&'a str],
    /// Names of the entry points.
    pub entries: &'a [&'a str],
    /// Where the threads add up their counters.
    pub counters: Counters<'a>,
}

/// Two atomic words: of estimates, then of orbit steps.
#[derive(Clone, Copy, Debug)]
pub enum Counters<'a> {
    /// Group and binding of a storage buffer that no entry point uses.
    Buffer([u32; 2]),
    /// Words that the module declares.
    Words([&'a str; 2]),
}

/// The joined text of `files`, with counters.
///
/// # Errors
/// If an entry point, a marked function or an orbit loop isn't in the text.
pub fn counting(files: &[File<'_>], marks: &Marks<'_>) -> Result<String, String> {
    let mut text = match marks.counters {
        Counters::Buffer([group, binding]) => format!(
            "@group({group}) @binding({binding}) var<storage, read_write> counts: array<atomic<u32>>;\n"
        ),
        Counters::Words(_) => String::new(),
    };
    text += "var<private> counted_estimates: u32;\nvar<private> counted_steps: u32;\n";
    let mut orbits = 0;
    for (path, file) in files {
        if path.starts_with(marks.orbits_in) {
            let (counted, found) = count_orbits(file, marks.other_loops);
            orbits += found;
            text += &counted;
        } else {
            text += file;
        }
        text += "\n";
    }
    if orbits == 0 {
        return Err(format!("there is no orbit in {}", marks.orbits_in));
    }
    for name in marks.estimates {
        let start = function(&text, name)?;
        let brace = start + text[start..].find('{').ok_or_else(|| missing(name))?;
        text.insert_str(brace + 1, " counted_estimates += 1u;");
    }
    for name in marks.steps {
        // Plain kernels have no near steps.
        let Ok(start) = function(&text, name) else { continue };
        let end = start + text[start..].find("\n}").ok_or_else(|| missing(name))?;
        text.insert_str(end + 1, "counted_steps += 1u;\n");
    }
    for name in marks.entries {
        wrap(&mut text, name, marks.counters)?;
    }
    Ok(text)
}

fn missing(name: &str) -> String {
    format!("there is no function {name}")
}

fn function(text: &str, name: &str) -> Result<usize, String> {
    text.find(&format!("fn {name}(")).ok_or_else(|| missing(name))
}

/// Counts each complete iteration of the innermost loops; a `break` leaves its iteration uncounted.
fn count_orbits(file: &str, other_loops: &[&str]) -> (String, u32) {
    let (mut text, mut found) = (String::new(), 0);
    let mut inside = false;
    // Open loops: the line that closes each, and whether it contains another loop.
    let mut open: Vec<(String, bool)> = Vec::new();
    for line in file.lines() {
        if let Some(rest) = line.strip_prefix("fn ") {
            inside = !other_loops.iter().any(|name| rest.starts_with(&format!("{name}(")));
        }
        let word = line.trim_start();
        let is_loop =
            ["for ", "for(", "while ", "while(", "loop "].iter().any(|w| word.starts_with(w));
        if let Some((_, has_inner)) = open.pop_if(|(close, _)| close == line) {
            if !has_inner {
                text += "counted_steps += 1u;\n";
                found += 1;
            }
        } else if inside && is_loop && line.ends_with('{') {
            if let Some((_, has_inner)) = open.last_mut() {
                *has_inner = true;
            }
            let indentation = &line[..line.len() - word.len()];
            open.push((format!("{indentation}}}"), false));
        }
        text += line;
        text += "\n";
    }
    (text, found)
}

/// Replaces an entry point by one that calls it and adds up the counters.
fn wrap(text: &mut String, name: &str, counters: Counters<'_>) -> Result<(), String> {
    let [estimates, steps] = match counters {
        Counters::Buffer(_) => ["counts[0]", "counts[1]"],
        Counters::Words(words) => words,
    };
    let start = function(text, name)?;
    let attributes = text[..start].rfind("@compute").ok_or_else(|| missing(name))?;
    let open = start + text[start..].find('(').ok_or_else(|| missing(name))?;
    let close = open + text[open..].find(") {").ok_or_else(|| missing(name))?;
    let header = text[attributes..start].to_owned();
    let parameters = text[open + 1..close].to_owned();
    // The part after the attribute: `name: type`.
    let plain: Vec<_> = parameters
        .split(',')
        .filter_map(|parameter| parameter.rsplit_once(')'))
        .map(|(_, declared)| declared.trim())
        .collect();
    let names: Vec<_> = plain.iter().filter_map(|p| p.split(':').next()).collect();
    let inner = format!("fn counted_{name}({}", plain.join(", "));
    text.replace_range(attributes..close, &inner);
    *text += &format!(
        "{header}fn {name}({parameters}) {{\n    counted_{name}({});\n    \
         atomicAdd(&{estimates}, counted_estimates);\n    atomicAdd(&{steps}, counted_steps);\n}}\n",
        names.join(", ")
    );
    Ok(())
}
