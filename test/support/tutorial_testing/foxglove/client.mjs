/** Clients with npm's @foxglove/ws-protocol: a command a line in, an event a line out, in JSON. */

import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const require = createRequire(`${process.argv[2]}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader, MessageWriter } = require("@foxglove/rosmsg-serialization");
const { WebSocket } = require("ws");

const jsonOf = (_key, value) => (typeof value === "bigint" ? value.toString() : value);
const say = (event) => process.stdout.write(`${JSON.stringify(event, jsonOf)}\n`);
const now_ms = () => performance.timeOrigin + performance.now();

/** A connection to the server; its commands are the methods without an underscore. */
class Connection {
  #socket;
  #client;
  #name;
  #channels = new Map(); // by topic
  #wanted = new Map(); // topic: what becomes of its messages
  #subscriptions = new Map(); // id: {topic, then, reader}
  #services = new Map();
  #published = new Map(); // topic: {id, writer}
  #calls = new Map(); // id: reader of its response
  #count = 0; // of all messages that are not said
  #delays_ms = [];
  #numbers = []; // of the same messages, which ROS counts up

  constructor(name, url, protocols) {
    this.#name = name;
    this.#socket = new WebSocket(url, protocols);
    this.#client = new FoxgloveClient({ ws: this.#socket });
    this.#client.on("open", () => this.#say("open", { protocol: this.#socket.protocol }));
    this.#client.on("error", (error) => this.#say("error", { message: String(error) }));
    this.#client.on("close", ({ code }) => this.#say("close", { code }));
    for (const name of ["serverInfo", "status", "time", "parameterValues", "connectionGraphUpdate",
      "serviceCallFailure", "unadvertise"]) {
      this.#client.on(name, (data) => this.#say(name, { data }));
    }
    this.#client.on("advertise", (channels) => this.#advertised(channels));
    this.#client.on("advertiseServices", (services) => {
      for (const service of services) this.#services.set(service.name, service);
      this.#say("advertiseServices", { data: services });
    });
    this.#client.on("message", (message) => this.#received(message));
    this.#client.on("serviceCallResponse", ({ callId, data }) =>
      this.#say("serviceCallResponse", { data: this.#calls.get(callId).readMessage(data) }));
    this.#client.on("fetchAssetResponse", ({ status, error, data }) =>
      this.#say("fetchAssetResponse", { status, error, bytes: data?.byteLength }));
  }

  /** then: "data" says each message, "delays" keeps the age of its stamp, "count" counts it. */
  subscribe({ topics, then = "data" }) {
    for (const topic of topics) {
      this.#wanted.set(topic, then);
      if (this.#channels.has(topic)) this.#begin(topic);
    }
  }

  unsubscribe({ topics }) {
    for (const [id, { topic }] of this.#subscriptions) {
      if (!topics.includes(topic)) continue;
      this.#client.unsubscribe(id);
      this.#subscriptions.delete(id);
    }
  }

  call({ service, request }) {
    const { id, request: asked, response } = this.#services.get(service);
    const callId = this.#calls.size + 1;
    this.#calls.set(callId, new MessageReader(parse(response.schema)));
    const data = new MessageWriter(parse(asked.schema)).writeMessage(request);
    this.#client.sendServiceCallRequest({ serviceId: id, callId, encoding: "ros1", data });
  }

  getParameters({ names }) {
    this.#client.getParameters(names, "get");
  }

  setParameters({ parameters }) {
    this.#client.setParameters(parameters, "set");
  }

  subscribeParameterUpdates({ names }) {
    this.#client.subscribeParameterUpdates(names);
  }

  subscribeConnectionGraph() {
    this.#client.subscribeConnectionGraph();
  }

  fetchAsset({ uri }) {
    this.#client.fetchAsset(uri, 1);
  }

  advertise({ topic, schemaName, schema }) {
    const id = this.#client.advertise({ topic, encoding: "ros1", schemaName });
    this.#published.set(topic, { id, writer: new MessageWriter(parse(schema)) });
  }

  publish({ topic, messages }) {
    const { id, writer } = this.#published.get(topic);
    for (const message of messages) this.#client.sendMessage(id, writer.writeMessage(message));
  }

  unadvertise({ topic }) {
    this.#client.unadvertise(this.#published.get(topic).id);
    this.#published.delete(topic);
  }

  stopReading() {
    this.#socket.pause();
  }

  report() {
    const content = { delays_ms: this.#delays_ms, numbers: this.#numbers, count: this.#count };
    this.#say("report", content);
    [this.#delays_ms, this.#numbers, this.#count] = [[], [], 0];
  }

  close() {
    this.#client.close();
  }

  #say(event, content) {
    say({ name: this.#name, event, ...content });
  }

  #advertised(channels) {
    for (const channel of channels) {
      this.#channels.set(channel.topic, channel);
      if (this.#wanted.has(channel.topic)) this.#begin(channel.topic);
    }
    this.#say("advertise", { data: channels });
  }

  #begin(topic) {
    const { id, schema } = this.#channels.get(topic);
    const [reader, writer] = [new MessageReader(parse(schema)), new MessageWriter(parse(schema))];
    const subscription = { topic, reader, writer, then: this.#wanted.get(topic) };
    this.#subscriptions.set(this.#client.subscribe(id), subscription);
  }

  #received({ subscriptionId, data }) {
    const subscription = this.#subscriptions.get(subscriptionId);
    if (!subscription) return; // it has just ended
    const { topic, reader, writer, then } = subscription;
    if (then !== "data") this.#count += 1;
    if (then === "count") return;
    const message = reader.readMessage(data);
    if (then === "delays") {
      const { seq, stamp } = message.header;
      this.#delays_ms.push(now_ms() - (1e3 * stamp.sec + 1e-6 * stamp.nsec));
      this.#numbers.push(seq);
      return;
    }
    const bytes = Buffer.from(data.buffer, data.byteOffset, data.byteLength);
    const isSame = bytes.equals(writer.writeMessage(message));
    this.#say("message", { topic, isSame, data: bytes.toString("base64") });
  }
}

const connections = new Map();
for await (const line of createInterface({ input: process.stdin })) {
  const { name, command, ...content } = JSON.parse(line);
  if (command === "connect") {
    connections.set(name, new Connection(name, content.url, content.protocols));
  } else {
    connections.get(name)[command](content);
  }
}
process.exit();
