/** The connection to the server: JSON messages both ways, and its return after a loss. */

const RETRY_MS = 500;
const CONNECT_MS = 3000; // after which an attempt is given up: a cut network answers nothing
const QUIET_MS = 1000; // the robots' places come 20 times a second, so that silence is a loss
const FULL = 4096; // [byte] waiting to be sent: what is added now would come late

export class Link {
  #socket = null;
  #handlers = new Map();
  #lastHeard = 0;
  #heardRobots = false;
  #attempt = 0;

  /** onState(state): "connecting", "open" or "lost". */
  constructor(onState) {
    this.onState = onState;
    setInterval(() => this.#watch(), 250);
  }

  /** Call handler(message) for each message of a kind. */
  on(kind, handler) {
    this.#handlers.set(kind, [...(this.#handlers.get(kind) ?? []), handler]);
  }

  connect() {
    this.#attempt = performance.now();
    this.#heardRobots = false;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const token = new URLSearchParams(location.search).get("token");
    const query = token === null ? "" : `?token=${encodeURIComponent(token)}`;
    const socket = new WebSocket(`${scheme}://${location.host}/ws${query}`);
    this.#socket = socket;
    socket.onopen = () => {
      this.#lastHeard = performance.now();
      this.onState("open");
    };
    socket.onmessage = (event) => this.#hear(event.data);
    socket.onclose = () => this.#lose(socket);
  }

  get isOpen() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Send a message, or drop it: nothing waits for a better time. Returns whether it was sent. */
  send(kind, fields = {}) {
    if (!this.isOpen || this.#socket.bufferedAmount > FULL) return false;
    this.#socket.send(JSON.stringify({ kind, ...fields }));
    return true;
  }

  #hear(text) {
    this.#lastHeard = performance.now();
    const message = JSON.parse(text);
    if (message.kind === "robots") this.#heardRobots = true;
    for (const handler of this.#handlers.get(message.kind) ?? []) handler(message);
  }

  #watch() {
    const now = performance.now();
    const state = this.#socket?.readyState;
    if (document.hidden) {
      this.#lastHeard = now; // timers and messages of a hidden page come late, which is no loss
    } else if (state === WebSocket.OPEN && this.#heardRobots && now - this.#lastHeard > QUIET_MS) {
      this.#lose(this.#socket);
    } else if (state === WebSocket.CONNECTING && now - this.#attempt > CONNECT_MS) {
      this.#lose(this.#socket);
    }
  }

  #lose(socket) {
    if (socket !== this.#socket) return; // given up before
    this.#socket = null;
    socket.onmessage = socket.onopen = null;
    socket.close();
    this.onState("lost");
    setTimeout(() => this.connect(), RETRY_MS);
  }
}
