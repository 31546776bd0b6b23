// The page of the 3-D view: meshcat's viewer, which receives drawing commands through one socket.
"use strict";

(() => {
  // Without a message for this time the drawing counts as out of date.
  const QUIET_MS = 3000;
  const RETRY_MS = 1000;
  const NO_WEBGL =
    "The 3-D view needs WebGL, which this browser does not offer.\n" +
    "Switch hardware acceleration on in its settings, or open the view in another browser.\n" +
    "Everything else in the program works without it.";
  const pane = document.getElementById("pane");
  const warnings = document.getElementById("warnings");
  const failure = document.getElementById("failure");

  let viewer;
  let notes = [];
  // These texts apply until the first note brings those in the language of the program.
  let words = {
    silent: "The program does not answer: the drawing is out of date.",
    quiet: "No data from the program: the drawing is out of date.",
  };
  let isOld = false;
  let lastMessageMs = performance.now();
  let connected = false;

  function showFailure(text) {
    failure.textContent = text;
  }

  function makeViewer() {
    if (typeof MeshCat === "undefined") {
      showFailure("The viewer could not be loaded. Open the view again from the program.");
      return false;
    }
    try {
      viewer = new MeshCat.Viewer(pane);
    } catch (error) {
      console.error(error);
      showFailure(NO_WEBGL);
      return false;
    }
    const canvas = viewer.renderer.domElement;
    canvas.addEventListener("webglcontextlost", () => {
      showFailure(
        "The graphics driver has dropped the picture. Open the view again from the program.",
      );
    });
    showFailure("");
    return true;
  }

  // The camera is in the coordinates of three.js, whose y axis points up: the point (x, y, z) of
  // the scene is (x, z, -y) there. Its parents must not be moved, since OrbitControls ignores them.
  function moveCamera({ target: [x, y, z], eye: [right, back, up], near }) {
    viewer.camera.near = near;
    viewer.camera.far = 1e4 * near;
    viewer.controls.target.set(x, z, -y);
    viewer.camera.position.set(x + right, z + up, -(y + back));
    viewer.controls.update();
  }

  function showNote(command) {
    for (const ghost of ["model", "real"]) {
      const entry = document.getElementById(ghost);
      entry.hidden = !command.shown.includes(ghost);
      entry.firstElementChild.style.color = command.colours[ghost];
      entry.lastChild.textContent = " " + command.words[ghost];
    }
    words = command.words;
    notes = command.warnings;
    isOld = command.old;
  }

  function execute(command) {
    if (command.type === "view") moveCamera(command);
    else if (command.type === "note") showNote(command);
    else if (command.type !== "alive") viewer.handle_command(command);
  }

  function showState() {
    const quiet = performance.now() - lastMessageMs > QUIET_MS;
    const lost = !connected
      ? [words.silent]
      : quiet ? [words.quiet] : [];
    warnings.textContent = [...lost, ...notes].join("\n");
    pane.className = isOld || lost.length > 0 ? "old" : "";
  }

  function connect() {
    const address = location.href.replace(/^http/, "ws").replace(/[^/]*$/, "socket");
    const socket = new WebSocket(address);
    socket.onmessage = (message) => {
      connected = true;
      lastMessageMs = performance.now();
      for (const command of JSON.parse(message.data)) execute(command);
      viewer.set_dirty();
      showState();
      // The next message is sent only after this one was drawn, so there is no backlog, and a
      // hidden page receives nothing.
      requestAnimationFrame(() => socket.readyState === WebSocket.OPEN && socket.send("drawn"));
    };
    socket.onclose = () => {
      connected = false;
      showState();
      setTimeout(connect, RETRY_MS);
    };
  }

  if (makeViewer()) {
    connect();
    setInterval(showState, RETRY_MS);
  }
})();
