/** The tab Parameters: what is on the parameter server. */

import { byId, row } from "./dom.js";

export class ParametersTab {
  static title = "Parameters";
  static panel = `<div class="scroll"><table><tbody id="parameter-rows"></tbody></table></div>`;
  static watches = { parameters: false };

  constructor(link, watch) {
    this.watch = watch;
    link.on("parameters", ({ parameters }) => {
      byId("parameter-rows").replaceChildren(...parameters.map((pair) => row(...pair)));
    });
  }

  show(on) {
    this.watch({ parameters: on });
  }
}
