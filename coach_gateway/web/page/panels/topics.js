// The topics of a file without a match: how many messages each has, how often, and where it begins.

import { byId, element } from "../shared/elements.js";
import { clockText } from "../parts/text.js";

export class Topics {
  constructor(match, jump) {
    match.on("welcome", () => byId("topic-rows").replaceChildren(...match.topics.map((topic) => row(topic, match.may("replay") && jump))));
  }
}

function row({ key, encoding, schema, messages, start, end }, jump) {
  const rate = end > start ? ((messages - 1) / (end - start)).toFixed(1) : "";
  const from = clockText(start);
  const first = jump ? element("button", { type: "button", title: `Go to the first message of ${key}`, on: { click: () => jump(start) } }, from) : from;
  const name = element("th", { scope: "row" }, key, element("span", { class: "quiet" }, `${encoding} ${schema}`));
  return element("tr", {}, name, ...[String(messages), rate, first].map((one) => element("td", {}, one)));
}
