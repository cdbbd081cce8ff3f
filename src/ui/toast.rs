//! A notice that goes by itself after some seconds.
//!
//! In: notices, and the time. Out: the notice to show.

use super::display_inputs::Notice;

/// The notice to the visitor, until it is taken away or its time is over.
#[derive(Debug, Default)]
pub struct Toast {
    notice: Option<Notice>,
    until_secs: f64,
}

impl Toast {
    /// Shows a notice instead of the present one, until `until_secs`.
    pub fn show(&mut self, notice: Notice, until_secs: f64) {
        *self = Self { notice: Some(notice), until_secs };
    }

    /// The notice that is shown.
    pub fn notice(&self) -> Option<&Notice> {
        self.notice.as_ref()
    }

    /// Removes the notice, and returns it.
    pub fn take(&mut self) -> Option<Notice> {
        self.notice.take()
    }

    /// Removes a notice whose time is over. Returns whether it did so.
    pub fn expire(&mut self, now_secs: f64) -> bool {
        let is_over = self.notice.is_some() && now_secs >= self.until_secs;
        if is_over {
            self.notice = None;
        }
        is_over
    }

    /// The seconds until the notice goes; none without a notice, or for one that stays.
    pub fn remaining_secs(&self, now_secs: f64) -> Option<f64> {
        self.notice.as_ref()?;
        let left_secs = self.until_secs - now_secs;
        left_secs.is_finite().then_some(left_secs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notice(text: &str) -> Notice {
        Notice { text: text.to_owned(), ..Notice::default() }
    }

    fn text(toast: &Toast) -> Option<&str> {
        toast.notice().map(|notice| notice.text.as_str())
    }

    #[test]
    fn a_notice_goes_when_its_time_is_over_and_stays_gone() {
        let mut toast = Toast::default();
        assert!(!toast.expire(0.0));
        toast.show(notice("Saved."), 6.0);
        assert!(!toast.expire(5.9));
        assert_eq!((text(&toast), toast.remaining_secs(4.0)), (Some("Saved."), Some(2.0)));
        assert!(toast.expire(6.0));
        for now_secs in [6.0, 7.0, 1e9] {
            assert!(!toast.expire(now_secs), "it went once");
            assert_eq!((text(&toast), toast.remaining_secs(now_secs)), (None, None));
        }
    }

    #[test]
    fn a_newer_notice_has_its_own_time() {
        let mut toast = Toast::default();
        toast.show(notice("Saved."), 6.0);
        toast.show(notice("A failure"), 25.0);
        assert!(!toast.expire(6.0));
        assert_eq!(text(&toast), Some("A failure"));
        assert!(toast.expire(25.0));
    }

    #[test]
    fn an_offer_stays_until_it_is_taken() {
        let mut toast = Toast::default();
        toast.show(notice("An offer"), f64::INFINITY);
        assert!(!toast.expire(1e12));
        assert_eq!((text(&toast), toast.remaining_secs(1e12)), (Some("An offer"), None));
        assert!(toast.take().is_some() && toast.notice().is_none());
    }
}
