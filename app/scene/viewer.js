// The page of the 3-D view: meshcat's viewer, told by one socket what to draw.
"use strict";

(() => {
  const QUIET_MS = 3000; // without any message after which the picture counts as old
  const AGAIN_MS = 1000;
  const NO_WEBGL =
    "This browser offers no WebGL, which the 3-D view is drawn with.\n" +
    "Switch hardware acceleration on in its settings, or open the view in another browser.\n" +
    "Everything else in the program works without it.";
  const pane = document.getElementById("pane");
  const warnings = document.getElementById("warnings");
  const failure = document.getElementById("failure");

  let viewer;
  let notes = [];
  let words = {  // until the first note tells them in the program's language
    silent: "The program does not answer: what is drawn is old.",
    quiet: "No news from the program: what is drawn is old.",
  };
  let old = false;
  let heard = performance.now();
  let connected = false;

  function fail(text) {
    failure.textContent = text;
  }

  function makeViewer() {
    if (typeof MeshCat === "undefined") {
      fail("The viewer could not be loaded. Open the view again from the program.");
      return false;
    }
    try {
      viewer = new MeshCat.Viewer(pane);
    } catch (error) {
      console.error(error);
      fail(NO_WEBGL);
      return false;
    }
    const canvas = viewer.renderer.domElement;
    canvas.addEventListener("webglcontextlost", () => {
      fail("The graphics driver has dropped the picture. Open the view again from the program.");
    });
    fail("");
    return true;
  }

  // The camera lives in three.js' own world, whose y is up: there the scene's (x, y, z) is
  // (x, z, -y). Its parents stay where they are: OrbitControls would look past them.
  function look({ target: [x, y, z], eye: [right, back, up], near }) {
    viewer.camera.near = near;
    viewer.camera.far = 1e4 * near;
    viewer.controls.target.set(x, z, -y);
    viewer.camera.position.set(x + right, z + up, -(y + back));
    viewer.controls.update();
  }

  function note(command) {
    for (const ghost of ["model", "real"]) {
      const entry = document.getElementById(ghost);
      entry.hidden = !command.shown.includes(ghost);
      entry.firstElementChild.style.color = command.colours[ghost];
      entry.lastChild.textContent = " " + command.words[ghost];
    }
    words = command.words;
    notes = command.warnings;
    old = command.old;
  }

  function obey(command) {
    if (command.type === "view") look(command);
    else if (command.type === "note") note(command);
    else if (command.type !== "alive") viewer.handle_command(command);
  }

  function tellState() {
    const quiet = performance.now() - heard > QUIET_MS;
    const lost = !connected
      ? [words.silent]
      : quiet ? [words.quiet] : [];
    warnings.textContent = [...lost, ...notes].join("\n");
    pane.className = old || lost.length > 0 ? "old" : "";
  }

  function connect() {
    const address = location.href.replace(/^http/, "ws").replace(/[^/]*$/, "socket");
    const socket = new WebSocket(address);
    socket.onmessage = (message) => {
      connected = true;
      heard = performance.now();
      for (const command of JSON.parse(message.data)) obey(command);
      viewer.set_dirty();
      tellState();
      // The next one comes only after this one was drawn: no backlog, and none out of sight.
      requestAnimationFrame(() => socket.readyState === WebSocket.OPEN && socket.send("drawn"));
    };
    socket.onclose = () => {
      connected = false;
      tellState();
      setTimeout(connect, AGAIN_MS);
    };
  }

  if (makeViewer()) {
    connect();
    setInterval(tellState, AGAIN_MS);
  }
})();
