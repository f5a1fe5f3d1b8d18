// Draws the page of a database: what is chosen stands in the form and, so that it can be linked to, behind the # of the address.
// database.py puts the parts of the script, database_*.js and this one, into one function.
const data = JSON.parse(document.getElementById("data").textContent);
const form = document.querySelector(".choices");
const colours = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#a65298", "#56b4e9", "#626b78"];

const unique = (values) => [...new Set(values)];
const text = (value, digits = 3) => value === null ? "–" : String(Number(Number(value).toPrecision(digits)));
const share = (p) => p === null ? "–" : p < 0.0005 && p > 0 ? "< 0.0005" : p.toFixed(3);
const unit = (word) => word.unit === "1" ? "" : " " + word.unit;
const of = (words, name) => words.find((word) => word.name === name);
const escape = (words) => String(words).replace(/[&<>"]/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})[c]);

// ---- what is chosen
const wanted = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
const choice = (name) => form.elements[name].value;

function fill(name, options) {  // [value, label]; keeps what was chosen where it is still there
  const select = form.elements[name];
  const before = wanted[name] ?? select.value;
  select.innerHTML = options.map(([value, label]) => `<option value="${escape(value)}">${escape(label)}</option>`).join("");
  if (options.some(([value]) => String(value) === before)) select.value = before;
  select.parentElement.hidden = options.length < 2 && options.every(([value]) => value === "");
  delete wanted[name];
}

const ofClass = () => data.entries.map((entry, at) => ({...entry, at})).filter((entry) => entry.class === choice("class"));
function fillAll() {
  fill("class", data.classes.filter((name) => data.entries.some((e) => e.class === name)).map((name) => [name, name]));
  const entries = ofClass();
  fill("floor", unique(entries.map((e) => e.floor)).map((name) => [name, name || "–"]));
  const here = entries.filter((e) => e.floor === choice("floor"));
  fill("mu", unique(here.map((e) => e.mu_k)).sort((a, b) => a - b).map((mu) => [mu, "μ = " + text(mu)]));
  fill("im", data.intensities.map((w) => [w.name, w.symbol + unit(w)]));
  fill("demand", data.demands.map((w) => [w.name, w.binary ? w.name.replace("_", " ") : w.meaning]));
  const capacities = unique(data.curves.filter((c) => c.demand === choice("demand")).map((c) => c.capacity)).sort((a, b) => a - b);
  const demand = of(data.demands, choice("demand"));
  fill("capacity", demand.binary ? [[capacities[0], "it happens"]] : capacities.map((c) => [c, "> " + text(c) + unit(demand)]));
  if ("at" in wanted) form.elements.at.value = wanted.at;
  delete wanted.at;
  form.elements.at_text.textContent = `${of(data.intensities, choice("im")).symbol} = ${text(intensity())}${unit(of(data.intensities, choice("im")))}`;
}
const event = () => {
  const demand = of(data.demands, choice("demand"));
  return demand.binary ? demand.name.replace("_", " ") : `${demand.symbol} > ${text(choice("capacity"))}${unit(demand)}`;
};
const key = (im, demand, capacity, entry) => [im, demand, capacity, entry].join("\n");
const curves = new Map(data.curves.map((c) => [key(c.im, c.demand, c.capacity, c.entry), c]));
const curveOf = (at) => curves.get(key(choice("im"), choice("demand"), Number(choice("capacity")), at));
function range() {  // of the intensity, over all entries
  const all = data.curves.filter((c) => c.im === choice("im"));
  return [Math.min(...all.map((c) => c.im_least)), Math.max(...all.map((c) => c.im_most))];
}
function intensity() {
  const [low, high] = range();
  return Math.exp(Math.log(low) + Number(form.elements.at.value) / 100 * Math.log(high / low));
}

// ---- the table, and all of it
// A column that says nothing of any entry is left out; that none states it is told below.
function hideEmpty(body) {
  const unstated = [];
  [...body.parentElement.tHead.rows[0].cells].forEach((head, k) => {
    const told = unique([...body.rows].map((row) => row.cells[k].textContent));
    const none = told.length === 1 && ["", "–", "not stated"].includes(told[0]);
    if (none && told[0] === "not stated") unstated.push(head.textContent);
    [head, ...[...body.rows].map((row) => row.cells[k])].forEach((cell) => { cell.hidden = none; });
  });
  document.getElementById("unstated").textContent = unstated.length ? `Of no entry it is stated where ${unstated.join(" and ")}.` : "";
}

function fillTable(chosen, shown) {
  const body = document.querySelector("#entries tbody");
  body.innerHTML = shown.map((e) => {
    const c = curveOf(e.at), median = medianOf(c);
    return `<tr data-at="${e.at}" class="${chosen && e.at === chosen.at ? "chosen" : ""}"><td class="text">${escape(e.id)}</td><td>${text(e.width_m)}</td><td>${text(e.height_m)}</td><td>${text(e.mass_kg)}</td><td>${text(e.mu_k)}</td>` +
      `<td>${escape(sayMedian(median, c))}</td><td>${median && median.by === "lognormal" ? `${text(c.dispersion)} ± ${text(c.dispersion_se, 2)}` : "–"}</td>` +
      `<td class="text">${c ? (c.family === "lognormal" ? `lognormal, off by at most ${text(c.off_by, 2)}` : c.family === "not_refuted" ? `by its points; ${Number.isFinite(c.off_by) ? `a lognormal is not refuted, may be off by ${text(c.off_by, 2)}` : "a lognormal meets any two bins"}` : "by its points") : ""}${remark(median) && "; " + remark(median)}</td><td>${e.samples}</td><td>${e.version}</td><td class="text">${escape(e.description)}</td><td class="text">${escape(e.source)}</td></tr>`;
  }).join("");
  hideEmpty(body);
  for (const row of body.rows) row.addEventListener("click", () => { picked = Number(row.dataset.at); form.elements.mu.value = data.entries[picked].mu_k; draw(); });
}

let picked = null;
function draw() {
  fillAll();
  const shown = ofClass().filter((e) => e.floor === choice("floor"));
  const chosen = shown.find((e) => e.at === picked) ?? shown.find((e) => Math.abs(e.mu_k - Number(choice("mu"))) < 1e-9) ?? shown[0];
  measure();
  drawReferences();
  drawCurves(chosen, shown);
  drawClasses();
  fillTable(chosen, shown);
  const state = new URLSearchParams(["class", "mu", "floor", "demand", "capacity", "im", "at"].map((name) => [name, choice(name)]));
  history.replaceState(null, "", "#" + state);
}
form.addEventListener("input", (change) => { if (change.target.name !== "at") picked = null; draw(); });
addEventListener("resize", draw);
form.addEventListener("submit", (event) => event.preventDefault());
draw();
