//! `cargo xtask serve`: serves the page on 127.0.0.1.
//!
//! The server loads the built folder into memory once. Requests are looked up in a map of its
//! files, so a path such as `/..` cannot reach other files.

use std::{
    collections::BTreeMap,
    fs,
    io::{ErrorKind, Write as _},
    net::{Ipv4Addr, SocketAddr, TcpListener},
    path::Path,
    sync::Arc,
    thread,
};

use anyhow::{Context as _, Result, anyhow};
use tiny_http::{Header, Method, Response, Server};

use crate::{headers, page, shell};

/// The first port that `serve` tries by default.
pub const FIRST_PORT: u16 = 8080;

/// Number of ports that `serve` tries.
const PORTS_TRIED: u16 = 50;

/// Number of concurrent requests; a browser opens six connections to a host.
const WORKERS: usize = 6;

/// Builds the page and serves it until the program is stopped.
pub fn serve(first_port: u16) -> Result<()> {
    let folder = shell::target()?.join("page");
    page::build(&folder, page::Optimization::None)?;
    let site = Arc::new(Site::load(&folder)?);

    let listener = listen(first_port)?;
    let address = listener.local_addr().context("the server's address")?;
    let server = Server::from_listener(listener, None).map_err(|error| anyhow!("{error}"))?;
    println!("Mandelight is at http://{address}/");
    // A caller waits for this line; a pipe would buffer the line without the flush.
    std::io::stdout().flush().context("standard output")?;

    let server = Arc::new(server);
    let work = || {
        let (server, site) = (Arc::clone(&server), Arc::clone(&site));
        thread::spawn(move || answer_all(&server, &site))
    };
    let workers: Vec<_> = (0..WORKERS).map(|_| work()).collect();
    for worker in workers {
        worker.join().map_err(|_| anyhow!("a worker of the server stopped"))?;
    }
    Ok(())
}

/// Listens on the first free port from `first_port` on.
fn listen(first_port: u16) -> Result<TcpListener> {
    let last_port = first_port.saturating_add(PORTS_TRIED - 1);
    for port in first_port..=last_port {
        match TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port))) {
            Err(error) if error.kind() == ErrorKind::AddrInUse => {}
            other => return other.with_context(|| format!("port {port} of 127.0.0.1")),
        }
    }
    Err(anyhow!("the ports {first_port} to {last_port} are taken: choose one with --port"))
}

fn answer_all(server: &Server, site: &Site) {
    for request in server.incoming_requests() {
        let answer = site.answer(request.method(), request.url());
        let mut response = Response::from_data(answer.body).with_status_code(answer.status);
        let headers = [("Content-Type", answer.mime), ("Cache-Control", answer.cache_control)];
        for (name, value) in headers.into_iter().chain(headers::ALL) {
            // Names and values are constant ASCII texts, which are valid headers.
            response.add_header(Header::from_bytes(name, value).expect("a header"));
        }
        // A browser may close the connection before the response; this is not an error.
        let _ = request.respond(response);
    }
}

/// The built page: each file by its URL path (`/index.html`).
struct Site {
    files: BTreeMap<String, Vec<u8>>,
}

/// A response to the browser.
struct Answer {
    status: u16,
    mime: &'static str,
    cache_control: &'static str,
    body: Vec<u8>,
}

impl Site {
    fn load(folder: &Path) -> Result<Self> {
        let mut files = BTreeMap::new();
        let mut folders = vec![(folder.to_owned(), String::new())];
        while let Some((folder, path)) = folders.pop() {
            for entry in fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
                let file = entry?.path();
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                let path = format!("{path}/{name}");
                if file.is_dir() {
                    folders.push((file, path));
                } else {
                    let bytes = fs::read(&file).with_context(|| file.display().to_string())?;
                    files.insert(path, bytes);
                }
            }
        }
        Ok(Self { files })
    }

    /// The response to a request: a file of the page for `GET` and `HEAD`, else an error.
    fn answer(&self, method: &Method, url: &str) -> Answer {
        let plain = |status, text: &str| Answer {
            status,
            mime: "text/plain; charset=utf-8",
            cache_control: "no-store",
            body: text.as_bytes().to_vec(),
        };
        // tiny_http omits the body of a response to HEAD.
        if !matches!(method, Method::Get | Method::Head) {
            return plain(405, "only GET and HEAD\n");
        }
        let path = url.split(['?', '#']).next().unwrap_or_default();
        let path = if path == "/" { "/index.html" } else { path };
        match self.files.get(path) {
            Some(body) => Answer {
                status: 200,
                mime: mime_of(path),
                cache_control: headers::cache_control(path),
                body: body.clone(),
            },
            None => plain(404, "no such file\n"),
        }
    }
}

/// The media type of a file; browsers need `application/wasm` for streaming compilation.
fn mime_of(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("", |(_, extension)| extension) {
        "html" => "text/html; charset=utf-8",
        "webmanifest" => "application/manifest+json",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};

    use super::*;

    fn site() -> Site {
        let file = |path: &str| (path.to_owned(), path.as_bytes().to_vec());
        Site { files: ["/index.html", "/a-12.wasm", "/snippets/b.js"].map(file).into() }
    }

    #[test]
    fn files_have_their_media_type() {
        for (url, mime) in [
            ("/", "text/html; charset=utf-8"),
            ("/?test", "text/html; charset=utf-8"),
            ("/index.html?a=b", "text/html; charset=utf-8"),
            ("/a-12.wasm", "application/wasm"),
            ("/snippets/b.js", "text/javascript; charset=utf-8"),
        ] {
            let answer = site().answer(&Method::Get, url);
            assert_eq!((answer.status, answer.mime), (200, mime), "{url}");
            let is_document = mime.starts_with("text/html");
            assert_eq!(answer.cache_control == "no-cache", is_document, "{url}");
        }
    }

    #[test]
    fn nothing_outside_the_page_is_reachable() {
        for url in [
            "/../Cargo.toml",
            "/..%2fCargo.toml",
            "/%2e%2e/Cargo.toml",
            "/snippets/../index.html",
            "/snippets",
            "//etc/passwd",
            "/etc/passwd",
            "",
        ] {
            assert_eq!(site().answer(&Method::Get, url).status, 404, "{url}");
        }
    }

    #[test]
    fn only_get_and_head_are_allowed() {
        assert_eq!(site().answer(&Method::Head, "/").status, 200);
        for method in [Method::Post, Method::Put, Method::Delete, Method::Options] {
            assert_eq!(site().answer(&method, "/").status, 405, "{method}");
        }
    }

    #[test]
    fn answers_carry_the_headers() {
        let server = Server::http((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let address = server.server_addr().to_ip().unwrap();
        std::thread::spawn(move || answer_all(&server, &site()));
        let mut stream = std::net::TcpStream::connect(address).unwrap();
        write!(stream, "GET / HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let document = [("Cache-Control", "no-cache")];
        for (name, value) in headers::ALL.into_iter().chain(document) {
            assert!(answer.contains(&format!("{name}: {value}\r\n")), "{name}: {answer}");
        }
    }

    #[test]
    fn a_taken_port_is_skipped() {
        let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let port = taken.local_addr().unwrap().port();
        let next = listen(port).unwrap().local_addr().unwrap();
        assert!(next.ip().is_loopback());
        assert!(next.port() > port, "{next}");
    }
}
