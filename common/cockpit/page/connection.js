/**
 * The connection to the server: JSON messages both ways, and its return after a loss.
 *
 * Silence is shown at once as a loss. But the server may only be busy, or the Wi-Fi weak for a moment,
 * and a closed connection costs the driver's session: so it stays open for a while.
 */

const RETRY_MS = 500;
const QUIET_MS = 1000; // of silence are a loss: the robots' places come 20 times a second
const GIVE_UP_MS = {
  [WebSocket.CONNECTING]: 3000, // a cut network answers nothing
  [WebSocket.OPEN]: 4000, // the server waits as long for a silent page
};
const HOPE_MS = 6000; // of attempts in vain; then a person has to act
const FULL = 4096; // [byte] waiting to be sent: what is added now would come late

export class Link extends EventTarget {
  #socket = null;
  heardAt = 0; // when the newest message came [ms since 1970], also on a machine that slept since
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
      this.#lastHeard = now; // timers and messages of a hidden page come late, which is no loss
    } else if (silence > GIVE_UP_MS[state]) {
      this.#lose(this.#socket);
    } else if (state === WebSocket.OPEN && silence > QUIET_MS) {
      this.#become("lost");
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
