"""Only clients with the secret address, on this machine and from this page, get the scene."""

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

from rotemina.app.errors import ViewerError
from rotemina.app.scene import SceneCommandStore, ViewServer, page
from rotemina.app.scene.viewers import MAX_VIEWERS

TIMEOUT_S = 20.0
OPEN_WEBSOCKETS = []  # opened by the current conversation, each with its stream


@pytest.fixture
def scene():
    scene = SceneCommandStore()
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


def send_request(server, path=None, method="GET", **headers):
    """Send a request without changes; return status, headers and body."""
    address = urlsplit(server.url)
    connection = HTTPConnection("127.0.0.1", address.port, timeout=TIMEOUT_S)
    try:
        sent_headers = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.putrequest(method, path or address.path, skip_host="Host" in sent_headers)
        for name, value in sent_headers.items():
            connection.putheader(name, value)
        connection.endheaders()
        response = connection.getresponse()
        return response.status, response.headers, response.read()
    finally:
        connection.close()


async def connect(server, url=None, **headers):
    sent_headers = {"Origin": server.origin} | headers
    address = url or server.url.replace("http:", "ws:") + "socket"
    request = HTTPRequest(
        address, headers={name: value for name, value in sent_headers.items() if value is not None}
    )
    websocket = await asyncio.wait_for(websocket_connect(request), TIMEOUT_S)
    OPEN_WEBSOCKETS.append((websocket, websocket.protocol.stream))
    return websocket


def run_conversation(conversation):
    """Run a conversation and close every websocket that it has opened."""

    async def run_and_close():
        try:
            return await conversation
        finally:
            for websocket, stream in OPEN_WEBSOCKETS:
                websocket.close()
                stream.close()  # would otherwise wait for an answer beyond the end of this loop
            OPEN_WEBSOCKETS.clear()
            await asyncio.sleep(0)

    return asyncio.run(run_and_close())


async def receive(websocket):
    text = await asyncio.wait_for(websocket.read_message(), TIMEOUT_S)
    return text if text is None else {c["path"]: c["value"] for c in json.loads(text)}


def get_refusal_status(server, **options):
    """Return the status with which a websocket is refused, or None."""

    async def attempt():
        try:
            await connect(server, **options)
        except HTTPClientError as error:
            return error.code
        return None

    return run_conversation(attempt())


def test_client_with_the_address_gets_the_viewer(server):
    base = urlsplit(server.url).path
    for name, kind in (("", "text/html"), ("viewer.js", "text/javascript"), ("viewer.css", "text")):
        status, headers, body = send_request(server, base + name)
        assert status == 200
        assert headers["Content-Type"].startswith(kind)
        assert body
    _, _, viewer = send_request(server, base + "meshcat.js")
    assert b"MeshCat" in viewer


def test_wrong_secret_is_refused(server):
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
        status, _, body = send_request(server, path)
        assert (status, body) == (403, b""), path
    wrong_url = f"ws{server.origin[4:]}/{secret[:-1]}x/socket"
    assert get_refusal_status(server, url=wrong_url) == 403


def test_every_server_has_a_different_secret(scene):
    first, second = ViewServer(scene), ViewServer(scene)
    assert first._secret != second._secret
    assert first.close()  # it was never started


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1", "localhost:{}", "127.0.0.1.nip.io:{}"]
)
def test_other_host_header_is_refused(server, host):
    host = host.format(urlsplit(server.url).port)
    status, _, body = send_request(server, Host=host)
    assert (status, body) == (421, b"")
    assert get_refusal_status(server, Host=host) == 421


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1", "", None])
def test_another_origin_gets_no_websocket(server, origin):
    assert get_refusal_status(server, Origin=origin) == 403
    assert server.viewer_count == 0


def test_page_of_another_origin_gets_no_file(server):
    status, _, body = send_request(server, Origin="http://evil.example")
    assert (status, body) == (403, b"")
    https = server.origin.replace("http:", "https:")
    assert send_request(server, Origin=https)[0] == 403


def test_only_known_files_can_be_read_and_nothing_can_be_written(server):
    base = urlsplit(server.url).path
    for path in (
        "viewer.html",
        "page.py",
        "../server.py",
        "%2e%2e/server.py",
        "main.js",
        "x/socket",
    ):
        assert send_request(server, base + path)[0] == 404, path
    for method in ("POST", "PUT", "DELETE"):
        assert send_request(server, method=method, Content_Length="0")[0] == 405
    assert send_request(server, "*", "OPTIONS")[0] == 403


def test_security_headers_exclude_other_pages(server):
    _, headers, _ = send_request(server)
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


def test_server_listens_only_on_loopback(server):
    assert [listener.getsockname()[0] for listener in server._sockets] == ["127.0.0.1"]
    assert server._sockets[0].family == socket.AF_INET


def test_secret_is_not_logged(server, caplog):
    caplog.set_level(0)
    send_request(server)
    send_request(server, urlsplit(server.url).path + "nothing")
    get_refusal_status(server, Origin="http://evil.example")
    assert server._secret not in caplog.text


def test_fast_slow_and_returning_viewers_get_the_newest_state(server, scene):
    async def converse():
        first, second = await connect(server), await connect(server)
        assert await receive(first) == await receive(second) == {"/a": 1, "/b": 1}
        assert server.viewer_count == 2
        put(scene, "/a", 2)
        server.send_changes()
        for websocket in (first, second):
            await websocket.write_message("drawn")
            assert await receive(websocket) == {"/a": 2}
        for value in range(3, 6):
            put(scene, "/a", value)
            server.send_changes()
            await second.write_message("drawn")
            assert await receive(second) == {"/a": value}
        await first.write_message("drawn")  # it was slow: it blocked no other, and gets no backlog
        assert await receive(first) == {"/a": 5}
        first.close()
        returned = await connect(server)
        assert await receive(returned) == {"/a": 5, "/b": 1}

    run_conversation(converse())


@pytest.mark.parametrize("message", ["set_object", '{"type":"delete"}', b"drawn", "x" * 1000])
def test_viewer_that_sends_anything_else_is_disconnected(server, message):
    async def converse():
        websocket = await connect(server)
        assert await receive(websocket) is not None
        await websocket.write_message(message, binary=isinstance(message, bytes))
        assert await receive(websocket) is None

    run_conversation(converse())
    assert send_request(server)[0] == 200


def test_number_of_viewers_is_limited(server):
    async def connect_too_many():
        for _ in range(MAX_VIEWERS):
            await connect(server)
        with pytest.raises(HTTPClientError) as refusal:
            await connect(server)
        assert refusal.value.code == 503

    run_conversation(connect_too_many())


def test_close_disconnects_viewers_and_frees_the_port(scene):
    server = ViewServer(scene)
    server.start()
    port = urlsplit(server.url).port

    async def converse():
        websocket = await connect(server)
        await receive(websocket)
        await asyncio.to_thread(server.close)
        assert await receive(websocket) is None

    run_conversation(converse())
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", port)) != 0
    server.send_changes()  # has no effect after closing
    assert server.close()


def test_missing_page_file_is_named(monkeypatch, tmp_path):
    page.load_page_files.cache_clear()
    monkeypatch.setattr(page.resources, "files", lambda package: tmp_path)
    with pytest.raises(ViewerError, match=rf"{tmp_path}/.*install RoTeMiNa again"):
        page.load_page_files()
    page.load_page_files.cache_clear()


def test_included_viewer_equals_the_one_of_the_package():
    """With the extra 'meshcat', compare the included viewer with the one in that package."""
    spec = find_spec("meshcat")
    if spec is None:
        pytest.skip("needs the extra 'meshcat'")
    package_file = Path(spec.origin).with_name("viewer") / "dist" / "main.min.js"
    included_file = resources.files("rotemina.resources.meshcat").joinpath("main.min.js")
    assert included_file.read_bytes() == package_file.read_bytes()
