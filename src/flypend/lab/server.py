"""The server of the laboratory: a page, its script and a socket. By default it admits only this machine.

The origin check refuses a foreign site that makes a browser connect here (cross-site requests); the host check refuses
a foreign name that resolves to this server (DNS rebinding).
"""

from __future__ import annotations

import asyncio
import ipaddress
import socket
import threading
import webbrowser
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any
from urllib.parse import urlsplit

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream
from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from flypend import signals
from flypend.errors import InputError
from flypend.lab.answers import ANSWERS, refusal
from flypend.lab.controls import page
from flypend.lab.own import OwnLaws
from flypend.lab.session import Slot, read
from flypend.lab.shares import Shares
from flypend.lab.worker import Workers, encode
from flypend.pages import replay

LARGEST_MESSAGE = 64 * 1024  # bytes; a setting needs one or two thousand
MOST_PAGES = 32
MOST_CONNECTIONS = 128  # of all kinds; a browser opens a few for a page
SILENT = 30  # s until a connection without a request is closed
POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval' blob:; worker-src blob:; "
    "style-src 'unsafe-inline'; img-src data:; connect-src 'self' ws://{host}; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)


class Laboratory:
    """State shared by all pages: processes that answer them, their shares of the cores, and the set of open pages."""

    def __init__(self, host: str, own: OwnLaws | None = None) -> None:
        self.host, self.own = host, own or OwnLaws()
        self.pages: set[Socket] = set()
        self.shares, self.workers = Shares(), Workers(self.own)

    def trusts(self, host: str) -> bool:
        """Whether the Host header `host` names this server, and not a foreign name that resolves to it."""
        try:
            name = urlsplit(f"//{host}").hostname or ""
        except ValueError:  # it is none, such as [a
            return False
        asked, own = _address_in(name), _address_in(self.host)
        here = own is not None and own.is_loopback
        return name == self.host.lower() or (asked is not None and (asked.is_loopback or not here))

    def application(self) -> Application:
        """Build the Tornado application: page, script and socket."""
        shared = {"laboratory": self}
        return Application(
            [
                (r"/", Page, {**shared, "kind": "text/html", "content": page(self.own)}),
                (r"/page\.js", Page, {**shared, "kind": "text/javascript", "content": replay.program()}),
                (r"/socket", Socket, shared),
            ],
            log_function=lambda _: None,  # the client is told of a refusal; no need to log it
            websocket_max_message_size=LARGEST_MESSAGE,
            websocket_ping_interval=20,
            websocket_ping_timeout=20,
        )

    def close(self) -> None:
        """Close every page, and end every process."""
        for open_page in list(self.pages):
            open_page.leave()
        self.workers.close()


class Server(HTTPServer):
    """An HTTP server with a limit on connections, so that silent ones cannot use up the files of the process.

    An open page does not count: its connection has become a socket, of which there are at most MOST_PAGES.
    """

    connections = 0

    def handle_stream(self, stream: IOStream, address: tuple[Any, ...]) -> None:
        """Serve a new connection, unless there are too many."""
        if self.connections >= MOST_CONNECTIONS:
            stream.close()
            return
        self.connections += 1
        super().handle_stream(stream, address)

    def on_close(self, server_conn: object) -> None:
        """Forget a connection."""
        self.connections -= 1
        super().on_close(server_conn)


class Page(RequestHandler):
    """A file built once, at start."""

    def initialize(self, laboratory: Laboratory, kind: str, content: str) -> None:
        """Store `content`, of the media type `kind`."""
        self.laboratory, self.kind, self.content = laboratory, kind, content

    def prepare(self) -> None:
        """Refuse requests for another host."""
        if not self.laboratory.trusts(self.request.host):
            raise HTTPError(403)

    def get(self) -> None:
        """Send the file."""
        self.set_header("Content-Type", f"{self.kind}; charset=utf-8")
        self.set_header("Content-Security-Policy", POLICY.format(host=self.request.host))
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Referrer-Policy", "no-referrer")
        self.set_header("Cache-Control", "no-cache")
        self.write(self.content)


class Socket(WebSocketHandler):
    """The connection to one open page."""

    def initialize(self, laboratory: Laboratory) -> None:
        """Connect the page to `laboratory`, with a slot for each kind of request."""
        self.laboratory = laboratory
        share = laboratory.shares.page()
        self.slots = {
            kind: Slot(share, rank, laboratory.shares, laboratory.workers, self._send)
            for rank, kind in enumerate(ANSWERS)
        }

    def prepare(self) -> None:
        """Refuse requests for another host, and too many open pages."""
        if not self.laboratory.trusts(self.request.host):
            raise HTTPError(403)
        if len(self.laboratory.pages) >= MOST_PAGES:
            raise HTTPError(503)

    def check_origin(self, origin: str) -> bool:
        """Whether `origin` is this server's own page; no other may open a socket."""
        parts = urlsplit(origin)
        return parts.scheme in ("http", "https") and parts.netloc == self.request.host

    def open(self, *_: str, **__: str) -> None:
        """Register the page."""
        if len(self.laboratory.pages) >= MOST_PAGES:  # others may have opened since the request
            self.close(1013, "too many pages")
            return
        self.laboratory.pages.add(self)
        self.set_nodelay(True)

    async def on_message(self, message: str | bytes) -> None:
        """Put the request into its slot, or reply with the error."""
        try:
            asked = read(message)
        except InputError as error:
            await self._send(encode(refusal(error)))
            return
        if asked["kind"] == "stop":
            self.slots["map"].drop()
        else:
            self.slots[asked["kind"]].put(asked)

    def on_close(self) -> None:
        """Drop the page's requests."""
        self.leave()

    def leave(self) -> None:
        """Unregister the page and end its work."""
        self.laboratory.pages.discard(self)
        for slot in self.slots.values():
            slot.close()
        self.close()

    async def _send(self, reply: bytes) -> None:
        with suppress(WebSocketClosedError):
            await self.write_message(reply)


@signals.defer()
def serve(
    host: str = "127.0.0.1",
    port: int = 0,
    *,
    browser: bool = True,
    laws: Sequence[str] = (),
    announce: Callable[[str], Any] = print,
) -> None:
    """Serve the laboratory until the process is interrupted.

    Parameters
    ----------
    host : str
        Address to listen on; any but a loopback address admits other machines.
    port : int
        Port; 0 for a free one.
    browser : bool
        Whether to open the page in a browser.
    laws : sequence of str
        Custom laws to offer, as `file.py:function` or `module:function`.
    announce : callable
        Called with the address of the page once the server is listening.

    Raises
    ------
    InputError
        If the address is unavailable, or if a custom law cannot be loaded.
    """
    own = OwnLaws(laws)
    asyncio.run(_serve(_listen(host, port), Laboratory(host, own), browser, announce))


def _listen(host: str, port: int) -> socket.socket:
    if not 0 <= port < 65536:
        raise InputError("--port", "0 to 65535", port)
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        return socket.create_server((host, port), family=family)
    except (OSError, UnicodeError) as error:  # the latter of a name that no host can have
        why = getattr(error, "strerror", error)
        raise InputError("--host and --port", "an address to listen on", f"{host}:{port}: {why}") from None


async def _serve(
    listening: socket.socket, laboratory: Laboratory, browser: bool, announce: Callable[[str], Any]
) -> None:
    """Serve the `laboratory` until it is stopped, and `announce` its address."""
    listening.setblocking(False)
    server = Server(
        laboratory.application(), max_body_size=LARGEST_MESSAGE, idle_connection_timeout=SILENT, body_timeout=SILENT
    )
    server.add_socket(listening)
    url = address(laboratory.host, listening.getsockname()[1])
    announce(url)
    if browser:
        threading.Thread(target=webbrowser.open, args=(url,), daemon=True).start()  # some browsers block until closed
    preparing = asyncio.create_task(laboratory.workers.prepare())
    try:
        while not signals.is_accepted():
            await asyncio.sleep(signals.PERIOD)
    finally:
        preparing.cancel()
        server.stop()
        laboratory.close()
        await server.close_all_connections()


def address(host: str, port: int) -> str:
    """Return the URL, for a browser on this machine, of a server on `host` and `port`."""
    shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)  # noqa: S104
    return f"http{'://'}{shown}:{port}/"


def _address_in(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    """The address that `host` says; None for a name, which may resolve to any, but for localhost."""
    with suppress(ValueError):
        return ipaddress.ip_address("127.0.0.1" if host == "localhost" else host)
    return None
