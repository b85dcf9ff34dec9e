/** Clients of rosbridge: the messages of each second, a line each. URL MODULES CLIENTS TOPIC... */

import { createRequire } from "node:module";

const [url, modules, clients, ...topics] = process.argv.slice(2);
const { WebSocket } = createRequire(`${modules}/`)("ws");
let count = 0;
for (let k = 0; k < Number(clients); k += 1) {
  const socket = new WebSocket(url);
  socket.on("open", () => {
    for (const topic of topics) socket.send(JSON.stringify({ op: "subscribe", topic }));
  });
  socket.on("message", () => (count += 1));
}
setInterval(() => {
  process.stdout.write(`${count}\n`);
  count = 0;
}, 1000);
