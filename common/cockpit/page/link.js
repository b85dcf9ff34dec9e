/**
 * The connection to the server: JSON messages both ways, and its return after a loss.
 *
 * Silence is a loss, which is shown at once; but a silent server may only be busy, or the Wi-Fi weak for
 * a moment. So the connection is kept for a while: with it goes the driver's seat.
 */

const RETRY_MS = 500;
const CONNECT_MS = 3000; // after which an attempt is given up: a cut network answers nothing
const QUIET_MS = 1000; // the robots' places come 20 times a second, so that silence is a loss
const GONE_MS = 4000; // of silence; as long as the server waits for a page that does not answer
const HOPE_MS = 6000; // of attempts in vain; then a person has to do something
const FULL = 4096; // [byte] waiting to be sent: what is added now would come late

export class Link {
  #socket = null;
  #handlers = new Map();
  #lastHeard = 0;
  #attempt = 0;
  #lostAt = 0;
  #state = "connecting";

  /** onState(state): "open", "lost" or, after a while, "gone", at each change. */
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
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const token = new URLSearchParams(location.search).get("token");
    const query = token === null ? "" : `?token=${encodeURIComponent(token)}`;
    const socket = new WebSocket(`${scheme}://${location.host}/ws${query}`);
    this.#socket = socket;
    socket.onopen = () => {
      this.#lastHeard = performance.now();
      this.#become("open");
    };
    socket.onmessage = (event) => this.#hear(event.data);
    socket.onclose = () => this.#lose(socket);
  }

  get isOpen() {
    return this.#state === "open" && this.#socket.readyState === WebSocket.OPEN;
  }

  /** Send a message, or drop it: nothing waits for a better time. Returns whether it was sent. */
  send(kind, fields = {}) {
    if (!this.isOpen || this.#socket.bufferedAmount > FULL) return false;
    this.#socket.send(JSON.stringify({ kind, ...fields }));
    return true;
  }

  #become(state) {
    if (state === this.#state || (state === "lost" && this.#state === "gone")) return;
    if (state === "lost") this.#lostAt = performance.now();
    this.#state = state;
    this.onState(state);
  }

  #hear(text) {
    this.#lastHeard = performance.now();
    this.#become("open"); // after a silence
    const message = JSON.parse(text);
    for (const handler of this.#handlers.get(message.kind) ?? []) handler(message);
  }

  #watch() {
    const now = performance.now();
    const state = this.#socket?.readyState;
    const silence = now - this.#lastHeard;
    if (this.#state === "lost" && now - this.#lostAt > HOPE_MS) this.#become("gone");
    if (document.hidden) {
      this.#lastHeard = now; // timers and messages of a hidden page come late, which is no loss
    } else if (state === WebSocket.OPEN && silence > QUIET_MS) {
      if (silence > GONE_MS) this.#lose(this.#socket);
      else this.#become("lost");
    } else if (state === WebSocket.CONNECTING && now - this.#attempt > CONNECT_MS) {
      this.#lose(this.#socket);
    }
  }

  #lose(socket) {
    if (socket !== this.#socket) return; // given up before
    this.#socket = null;
    socket.onmessage = socket.onopen = null;
    socket.close();
    this.#become("lost");
    setTimeout(() => this.connect(), RETRY_MS);
  }
}
