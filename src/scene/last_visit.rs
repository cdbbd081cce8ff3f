//! Which scene a visit opens with: the address's, this tab's, or the one that was stored last.
//!
//! In: the stored texts, which may be damaged or a newer version's. Out: a project, and what to tell. This
//! module knows no browser.

use super::{document, link, project::Project};

/// The texts at the start of a visit.
#[derive(Clone, Copy, Debug, Default)]
pub struct StoredTexts<'a> {
    /// The fragment of the address, without `#`.
    pub fragment: Option<&'a str>,
    /// What this tab stored: a text of [`tab_text`].
    pub tab: Option<&'a str>,
    /// The document that any tab stored last.
    pub last: Option<&'a str>,
    /// The document that was stored last while `last` was a newer version's.
    pub older: Option<&'a str>,
}

/// The scene to open, and what is said of scenes that cannot be opened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Opened {
    /// The project; none if nothing was stored that can be read.
    pub project: Option<Project>,
    /// True if the scene is that of a link which this tab did not write.
    pub is_link: bool,
    /// What the visitor should know.
    pub problem: Option<String>,
}

/// The text that a tab stores: its address and its document, which may hold more than the address.
pub fn tab_text(fragment: &str, document: &str) -> String {
    format!("{fragment}\n{document}")
}

/// Chooses the scene.
///
/// A link comes first, unless this tab wrote it: then the tab's document is the same, or more of it. Another
/// tab's document comes last.
pub fn open(texts: &StoredTexts<'_>) -> Opened {
    let tab = texts.tab.and_then(|text| text.split_once('\n'));
    let is_own = |written: &str| texts.fragment.is_none_or(|fragment| fragment == written);
    if let Some((_, text)) = tab.filter(|(written, _)| is_own(written))
        && let Ok(project) = document::project_from_json(text)
    {
        return Opened { project: Some(project), ..Opened::default() };
    }
    let mut problem = None;
    if let Some(fragment) = texts.fragment {
        match link::project_from_fragment(fragment) {
            Ok(project) => {
                return Opened { project: Some(project), is_link: true, problem: None };
            }
            Err(error) => problem = Some(error.to_string()),
        }
    }
    let last = texts.last.map(|text| (text, document::project_from_json(text)));
    let project = match last {
        None => None,
        Some((_, Ok(project))) => Some(project),
        Some((text, Err(_))) if document::is_newer(text) => {
            problem.get_or_insert_with(|| NEWER.to_owned());
            texts.older.and_then(|text| document::project_from_json(text).ok())
        }
        Some((_, Err(error))) => {
            problem
                .get_or_insert_with(|| format!("The scene of the last visit is damaged: {error}"));
            None
        }
    };
    Opened { project, is_link: false, problem }
}

/// What is said of a newer version's scene.
const NEWER: &str = "The scene of the last visit was stored by a newer Mandelight and is kept. Reload the page to get the newer version and that scene.";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, dice::Dice, path::Key, presets};

    /// Two different scenes as documents and as fragments.
    fn two() -> [(Project, String, String); 2] {
        [presets::opening_scenes()[0].scene, presets::opening_scenes()[1].scene].map(|scene| {
            let project = Project::from(scene());
            let document = document::project_to_json_compact(&project);
            let fragment = link::project_to_fragment(&project).expect("a short link");
            (project, document, fragment)
        })
    }

    fn project(opened: &Opened) -> Option<&Project> {
        opened.project.as_ref()
    }

    #[test]
    fn a_tab_comes_back_to_its_own_scene_and_a_link_shows_its_own() {
        let [(mine, document, fragment), (theirs, other, other_fragment)] = two();
        let tab = tab_text(&fragment, &document);
        let texts = StoredTexts { tab: Some(&tab), last: Some(&other), ..StoredTexts::default() };
        // Reloaded, with the address as this tab left it, or without.
        for address in [Some(fragment.as_str()), None] {
            let opened = open(&StoredTexts { fragment: address, ..texts });
            assert_eq!((project(&opened), opened.is_link), (Some(&mine), false));
        }
        let opened = open(&StoredTexts { fragment: Some(&other_fragment), ..texts });
        assert_eq!((project(&opened), opened.is_link), (Some(&theirs), true));
        // A new tab has nothing of its own.
        let opened = open(&StoredTexts { tab: None, ..texts });
        assert_eq!(project(&opened), Some(&theirs));
        assert_eq!(open(&StoredTexts::default()), Opened::default());
    }

    #[test]
    fn a_reload_brings_a_path_back_that_is_too_long_for_an_address() {
        let (scene, mut dice) = (Scene::default(), Dice::new(3));
        let keys = (0..200).map(|index| {
            let mut scene = scene.clone();
            for stop in &mut scene.surface.gradient {
                stop.color = [(); 3].map(|()| dice.unit() as f32);
            }
            Key {
                time_secs: f64::from(index) / 3.0,
                easing: Default::default(),
                scene: scene.into(),
            }
        });
        let mut project = Project::from(scene.clone());
        project.path.keys = keys.collect();
        assert!(link::project_to_fragment(&project).is_err(), "too long");
        let fragment = link::to_fragment(&scene).expect("the scene alone");
        let tab = tab_text(&fragment, &document::project_to_json_compact(&project));
        let texts =
            StoredTexts { fragment: Some(&fragment), tab: Some(&tab), ..StoredTexts::default() };
        assert_eq!(open(&texts).project, Some(project));
    }

    #[test]
    fn what_is_damaged_is_said_and_a_newer_version_s_scene_is_told_apart() {
        let [(mine, document, fragment), (theirs, other, _)] = two();
        let newer = document.replacen(
            &format!("\"version\":{}", document::VERSION),
            &format!("\"version\":{},\"more\":[1]", document::VERSION + 1),
            1,
        );
        let texts = StoredTexts { last: Some(&newer), older: Some(&other), ..Default::default() };
        let opened = open(&texts);
        assert_eq!(
            opened,
            Opened { project: Some(theirs), problem: Some(NEWER.into()), is_link: false }
        );
        for damaged in
            ["", "\u{0}\u{fffd}", "[]", "{\"mandelight\":7}", &document[..document.len() / 2]]
        {
            let texts = StoredTexts { last: Some(damaged), tab: Some(damaged), ..texts };
            let opened = open(&texts);
            assert_eq!(opened.project, None);
            assert!(opened.problem.is_some_and(|text| text.contains("damaged")), "{damaged}");
            // The address still has the scene.
            let texts = StoredTexts { fragment: Some(&fragment), ..texts };
            assert_eq!(open(&texts).project.as_ref(), Some(&mine));
        }
        let opened = open(&StoredTexts {
            fragment: Some("s1=!"),
            last: Some(&document),
            ..Default::default()
        });
        assert_eq!(project(&opened), Some(&mine));
        assert!(opened.problem.is_some_and(|text| text.contains("link")));
    }
}
