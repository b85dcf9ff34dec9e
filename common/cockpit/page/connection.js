/**
 * The connection to the server: JSON messages in both directions, and reconnecting after a loss.
 *
 * Silence is shown at once as a loss. As the server may only be busy, or the Wi-Fi weak for a moment,
 * the connection stays open for a while: closing it ends the driver's session.
 */

const RETRY_MS = 500;
const QUIET_MS = 1000; // of silence are a loss, as the robots' places arrive 20 times a second
const GIVE_UP_MS = {
  [WebSocket.CONNECTING]: 3000, // A cut network does not answer.
  [WebSocket.OPEN]: 4000, // The server waits as long for a silent page.
};
const HOPE_MS = 6000; // of failed attempts; then a person has to act
const FULL = 4096; // [bytes] waiting to be sent; another message would arrive late

export class Link extends EventTarget {
  #socket = null;
  heardAt = 0; // arrival of the newest message [ms since 1970], which also counts the time that a machine sleeps
  #lastHeard = 0; // or when the connection was started
  #lostAt = 0;
  #state = "connecting";

  /** onState(state): "open", "lost" or, after a while, "gone", at each change. */
  constructor(onState) {
    super();
    this.onState = onState;
    setInterval(() => this.#watch(), 250);
  }

  /** Call handler(message) for each message of a kind, or handler(kind) for each that was "sent". */
  on(kind, handler) {
    this.addEventListener(kind, (/** @type {any} */ event) => handler(event.detail));
  }

  connect() {
    this.#lastHeard = performance.now();
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/ws${location.search}`); // with its token
    this.#socket = socket;
    socket.onopen = () => (this.#lastHeard = performance.now());
    socket.onmessage = (event) => this.#hear(event.data);
    socket.onclose = () => this.#lose(socket);
  }

  get isOpen() {
    return this.#state === "open" && this.#socket.readyState === WebSocket.OPEN;
  }

  /** Send a message now, or drop it. Returns whether it was sent. */
  send(kind, fields = {}) {
    if (!this.isOpen || this.#socket.bufferedAmount > FULL) return false;
    this.#socket.send(JSON.stringify({ kind, ...fields }));
    this.dispatchEvent(new CustomEvent("sent", { detail: kind }));
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
    this.heardAt = Date.now();
    this.#become("open"); // the connection is new, or was silent
    const message = JSON.parse(text);
    this.dispatchEvent(new CustomEvent(message.kind, { detail: message }));
  }

  #watch() {
    const now = performance.now();
    const state = this.#socket?.readyState; // undefined between two attempts
    const silence = now - this.#lastHeard;
    if (this.#state === "lost" && now - this.#lostAt > HOPE_MS) this.#become("gone");
    if (document.hidden) {
      this.#lastHeard = now; // A hidden page's timers and messages are late, which is no loss.
    } else if (silence > GIVE_UP_MS[state]) {
      this.#lose(this.#socket);
    } else if (state === WebSocket.OPEN && silence > QUIET_MS) {
      this.#become("lost");
    }
  }

  #lose(socket) {
    if (socket !== this.#socket) return; // It was given up before.
    this.#socket = null;
    socket.onmessage = socket.onopen = null;
    socket.close();
    this.#become("lost");
    setTimeout(() => this.connect(), RETRY_MS);
  }
}
