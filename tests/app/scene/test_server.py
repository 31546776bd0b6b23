"""Who gets the scene: whoever has the address, from this machine, from this page; nobody else."""

import asyncio
import json
import socket
import threading
from http.client import HTTPConnection
from importlib import resources
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

from rotemina.app.scene import page
from rotemina.app.scene.page import ViewerError
from rotemina.app.scene.scene import Scene
from rotemina.app.scene.server import ViewServer
from rotemina.app.scene.viewers import MOST

LONG_S = 20.0
LINES = []  # that the present conversation has opened, each with its stream


@pytest.fixture
def scene():
    scene = Scene()
    put(scene, "/a", 1)
    put(scene, "/b", 1)
    return scene


@pytest.fixture
def server(scene):
    server = ViewServer(scene)
    server.start()
    yield server
    assert server.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "3-D view"]


def put(scene, path, value):
    scene.put({"type": "set_transform", "path": path, "value": value})


def ask(server, path=None, method="GET", **headers):
    """Send a request as it stands; return status, headers and body."""
    address = urlsplit(server.url)
    line = HTTPConnection("127.0.0.1", address.port, timeout=LONG_S)
    try:
        given = {name.replace("_", "-"): value for name, value in headers.items()}
        line.putrequest(method, path or address.path, skip_host="Host" in given)
        for name, value in given.items():
            line.putheader(name, value)
        line.endheaders()
        answer = line.getresponse()
        return answer.status, answer.headers, answer.read()
    finally:
        line.close()


async def connect(server, url=None, **headers):
    given = {"Origin": server.origin} | headers
    address = url or server.url.replace("http:", "ws:") + "socket"
    request = HTTPRequest(address, headers={k: v for k, v in given.items() if v is not None})
    line = await asyncio.wait_for(websocket_connect(request), LONG_S)
    LINES.append((line, line.protocol.stream))
    return line


def run(talk):
    """Run a conversation, and close every line that it has opened."""

    async def whole():
        try:
            return await talk
        finally:
            for line, stream in LINES:
                line.close()
                stream.close()  # which would wait for an answer that this loop may not live to hear
            LINES.clear()
            await asyncio.sleep(0)

    return asyncio.run(whole())


async def hear(line):
    text = await asyncio.wait_for(line.read_message(), LONG_S)
    return text if text is None else {c["path"]: c["value"] for c in json.loads(text)}


def refused(server, **how):
    """Return the status with which a socket is refused."""

    async def attempt():
        try:
            await connect(server, **how)
        except HTTPClientError as error:
            return error.code
        return None

    return run(attempt())


# --- who is let in --------------------------------------------------------------------------------


def test_whoever_has_the_address_gets_the_viewer(server):
    base = urlsplit(server.url).path
    for name, kind in (("", "text/html"), ("viewer.js", "text/javascript"), ("viewer.css", "text")):
        status, headers, body = ask(server, base + name)
        assert status == 200
        assert headers["Content-Type"].startswith(kind)
        assert body
    _, _, viewer = ask(server, base + "meshcat.js")
    assert b"MeshCat" in viewer


def test_without_the_right_secret_nothing_is_told(server):
    secret = urlsplit(server.url).path.strip("/")
    assert len(secret) >= 40
    for path in (
        "/",
        "//",
        f"/{secret[:-1]}/",
        f"/{secret}x/",
        "/x/viewer.js",
        "/static/",
        "/%C3%A9/",
    ):
        status, _, body = ask(server, path)
        assert (status, body) == (403, b""), path
    wrong = f"ws{server.origin[4:]}/{secret[:-1]}x/socket"
    assert refused(server, url=wrong) == 403


def test_every_server_has_a_secret_of_its_own(scene):
    assert ViewServer(scene)._secret != ViewServer(scene)._secret


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1", "localhost:{}", "127.0.0.1.nip.io:{}"]
)
def test_another_host_is_refused(server, host):
    host = host.format(urlsplit(server.url).port)
    status, _, body = ask(server, Host=host)
    assert (status, body) == (421, b"")
    assert refused(server, Host=host) == 421


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1", "", None])
def test_another_origin_gets_no_socket(server, origin):
    assert refused(server, Origin=origin) == 403
    assert server.watching == 0


def test_a_page_of_another_origin_gets_no_file(server):
    status, _, body = ask(server, Origin="http://evil.example")
    assert (status, body) == (403, b"")
    https = server.origin.replace("http:", "https:")
    assert ask(server, Origin=https)[0] == 403


def test_there_are_no_other_files_and_nothing_can_be_sent(server):
    base = urlsplit(server.url).path
    for path in (
        "viewer.html",
        "page.py",
        "../server.py",
        "%2e%2e/server.py",
        "main.js",
        "x/socket",
    ):
        assert ask(server, base + path)[0] == 404, path
    for method in ("POST", "PUT", "DELETE"):
        assert ask(server, method=method, Content_Length="0")[0] == 405


def test_browsers_are_told_to_keep_others_out(server):
    _, headers, _ = ask(server)
    policy = headers["Content-Security-Policy"]
    for part in ("default-src 'none'", "frame-ancestors 'none'", "script-src 'self'"):
        assert part in policy
    assert f"connect-src ws{server.origin[4:]};" in policy
    assert "unsafe-eval" not in policy
    assert headers["Referrer-Policy"] == "no-referrer"
    assert headers["Cross-Origin-Resource-Policy"] == "same-origin"
    assert headers["Cache-Control"] == "no-store"
    assert "Server" not in headers
    assert "Access-Control-Allow-Origin" not in headers


def test_it_listens_on_loopback_alone(server):
    assert [each.getsockname()[0] for each in server._sockets] == ["127.0.0.1"]
    assert server._sockets[0].family == socket.AF_INET


def test_refusals_leave_no_secret_in_the_log(server, caplog):
    caplog.set_level(0)
    ask(server)
    ask(server, urlsplit(server.url).path + "nothing")
    refused(server, Origin="http://evil.example")
    assert server._secret not in caplog.text


# --- what viewers get -----------------------------------------------------------------------------


def test_several_viewers_see_the_same_and_one_that_comes_back_sees_everything(server, scene):
    async def look():
        first, second = await connect(server), await connect(server)
        assert await hear(first) == await hear(second) == {"/a": 1, "/b": 1}
        assert server.watching == 2
        put(scene, "/a", 2)
        server.changed()
        for line in (first, second):
            await line.write_message("drawn")
            assert await hear(line) == {"/a": 2}
        first.close()
        again = await connect(server)
        assert await hear(again) == {"/a": 2, "/b": 1}

    run(look())


def test_one_that_does_not_draw_keeps_nobody_waiting_and_gets_no_backlog(server, scene):
    async def look():
        slow, fast = await connect(server), await connect(server)
        await hear(slow)
        await hear(fast)
        for value in range(2, 6):
            put(scene, "/a", value)
            server.changed()
            await fast.write_message("drawn")
            assert await hear(fast) == {"/a": value}
        await slow.write_message("drawn")
        assert await hear(slow) == {"/a": 5}

    run(look())


@pytest.mark.parametrize("said", ["set_object", '{"type":"delete"}', b"drawn", "x" * 1000])
def test_a_viewer_that_says_anything_else_is_let_go(server, said):
    async def speak():
        line = await connect(server)
        assert await hear(line) is not None
        await line.write_message(said, binary=isinstance(said, bytes))
        assert await hear(line) is None

    run(speak())
    assert ask(server)[0] == 200


def test_there_are_only_so_many_viewers(server):
    async def crowd():
        for _ in range(MOST):
            await connect(server)
        with pytest.raises(HTTPClientError) as refusal:
            await connect(server)
        assert refusal.value.code == 503

    run(crowd())


# --- begin and end --------------------------------------------------------------------------------


def test_closing_lets_go_of_viewers_and_of_the_port(scene):
    server = ViewServer(scene)
    server.start()
    port = urlsplit(server.url).port

    async def look():
        line = await connect(server)
        await hear(line)
        await asyncio.to_thread(server.close)
        assert await hear(line) is None

    run(look())
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", port)) != 0
    server.changed()  # too late, and harmless
    assert server.close()


def test_one_that_was_never_started_can_be_closed(scene):
    assert ViewServer(scene).close()


def test_a_missing_file_is_named(monkeypatch, tmp_path):
    page.page_files.cache_clear()
    monkeypatch.setattr(page.resources, "files", lambda package: tmp_path)
    with pytest.raises(ViewerError, match=rf"{tmp_path}/.*install RoTeMiNa again"):
        page.page_files()
    page.page_files.cache_clear()


def test_the_viewer_is_the_one_of_the_package():
    """Whoever has the extra 'meshcat' sees that what we carry is what that package ships."""
    spec = find_spec("meshcat")
    if spec is None:
        pytest.skip("needs the extra 'meshcat'")
    shipped = Path(spec.origin).with_name("viewer") / "dist" / "main.min.js"
    carried = resources.files("rotemina.resources.meshcat").joinpath("main.min.js")
    assert carried.read_bytes() == shipped.read_bytes()


def test_a_request_about_the_server_as_a_whole_is_refused(server):
    assert ask(server, "*", "OPTIONS")[0] == 403
