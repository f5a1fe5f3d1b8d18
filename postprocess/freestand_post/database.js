// Draws the page of a database: what is chosen stands in the form and, so that it can be linked to, behind the # of the address.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const form = document.querySelector(".choices");
  const colours = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#a65298", "#56b4e9", "#626b78"];
  const [IM, P, LOW, HIGH, N] = [0, 1, 2, 3, 4];  // of a point
  const WIDTH = 900, LEFT = 62, RIGHT = 190, TOP = 16, BOTTOM = 46;

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
  // Probability and band at an intensity, as `freestand query` and exports read the curve: its lognormal where that is adequate, else
  // straight lines over the intensity between the points, from 0 at 0; nothing outside of what was swept.
  function at(curve, im) {
    const points = curve ? curve.points : [];
    if (!points.length || im < curve.im_least * (1 - 1e-6) || im > curve.im_most * (1 + 1e-6)) return null;
    const next = points.findIndex((p) => p[IM] >= im), last = points[points.length - 1];
    const b = next < 0 ? last : points[next], a = next < 0 ? last : next === 0 ? [0, 0, 0, b[HIGH]] : points[next - 1];
    const t = b === a ? 1 : (im - a[IM]) / (b[IM] - a[IM]);
    let [p, low, high] = [P, LOW, HIGH].map((i) => (1 - t) * a[i] + t * b[i]);
    if (!byLognormal(curve)) return [p, low, high];
    const fitted = phi(Math.log(im / curve.median) / curve.dispersion), along = im < points[0][IM] || im > last[IM] ? fitted - p : 0;
    return [fitted, Math.max(0, Math.min(low + along, fitted)), Math.min(1, Math.max(high + along, fitted))];
  }
  const byLognormal = (curve) => curve.family === "lognormal" && curve.dispersion > 0;
  const ruleOf = (curve) => !curve ? "" : byLognormal(curve) ? "read by its lognormal, which is adequate" : "read by straight lines between its points over the intensity";
  // What the rule draws: [im, probability, lower, upper], finely, with the points themselves in it.
  function trace(curve) {
    const ims = curve.points.flatMap((p, i) => i ? [1, 2, 3, 4, 5, 6, 7, 8].map((k) => curve.points[i - 1][IM] * (p[IM] / curve.points[i - 1][IM]) ** (k / 8)) : [p[IM]]);
    return ims.map((im) => [im, ...(at(curve, im) ?? [])]).filter((p) => p.length > 1);
  }
  // Standard normal distribution (Abramowitz and Stegun 26.2.17; error below 1e-7).
  function phi(z) {
    const t = 1 / (1 + 0.2316419 * Math.abs(z));
    const tail = Math.exp(-z * z / 2) / Math.sqrt(2 * Math.PI) * t * (0.31938153 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
    return z > 0 ? 1 - tail : tail;
  }

  // ---- drawing
  function ticks(low, high) {
    const all = [];
    for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade)
      for (const digit of [1, 2, 5]) if (digit * 10 ** decade >= low * 0.999 && digit * 10 ** decade <= high * 1.001) all.push(digit * 10 ** decade);
    return all;
  }
  function frame(height, x, y, label) {  // of a probability over an intensity
    let made = "";
    for (const p of [0, 0.2, 0.4, 0.6, 0.8, 1])
      made += `<line class="rule" x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${y(p)}" y2="${y(p)}"/><text class="tick" x="${LEFT - 8}" y="${y(p) + 4}" text-anchor="end">${p}</text>`;
    for (const v of ticks(...x.range))
      made += `<line class="axis" x1="${x(v)}" x2="${x(v)}" y1="${height - BOTTOM}" y2="${height - BOTTOM + 5}"/><text class="tick" x="${x(v)}" y="${height - BOTTOM + 19}" text-anchor="middle">${text(v)}</text>`;
    return made + `<line class="axis" x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${height - BOTTOM}" y2="${height - BOTTOM}"/>` +
      `<text x="${(LEFT + WIDTH - RIGHT) / 2}" y="${height - 8}" text-anchor="middle">${escape(label)}</text>`;
  }
  function logScale(low, high) {
    const scale = (value) => LEFT + (WIDTH - LEFT - RIGHT) * Math.log(value / low) / Math.log(high / low);
    scale.range = [low, high];
    scale.back = (place) => low * (high / low) ** ((place - LEFT) / (WIDTH - LEFT - RIGHT));
    return scale;
  }
  const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

  function show(name, height, drawing, finding, reading, table) {
    const figure = document.getElementById(name);
    figure.querySelector(".drawing").innerHTML = `<svg viewBox="0 0 ${WIDTH} ${height}" role="img" aria-label="${escape(finding)}">${drawing}</svg>`;
    figure.querySelector(".finding").textContent = finding;
    figure.querySelector(".reading").textContent = reading;
    figure.querySelector(".readout").textContent = "";
    const cell = (value) => value === null || value === undefined ? "" : /[",\n]/.test(value) ? `"${String(value).replace(/"/g, '""')}"` : value;
    figure.querySelector(".download").href = "data:text/csv;charset=utf-8," + encodeURIComponent(table.map((row) => row.map(cell).join(",")).join("\n") + "\n");
    return figure;
  }
  // Labels at the right end, kept apart.
  function labels(entries) {
    const sorted = entries.slice().sort((a, b) => a.y - b.y);
    sorted.forEach((label, i) => { label.at = i ? Math.max(label.y, sorted[i - 1].at + 15) : label.y; });
    return sorted.map(({at, y, colour, words, bold}) => `<path d="M${WIDTH - RIGHT} ${y}L${WIDTH - RIGHT + 10} ${at}" stroke="${colour}" fill="none" stroke-width="0.8"/>` +
      `<text x="${WIDTH - RIGHT + 14}" y="${at + 4}" style="fill:${colour};font-weight:${bold ? 700 : 400}">${escape(words)}</text>`).join("");
  }

  function drawCurves(chosen, shown) {
    const height = 420, word = of(data.intensities, choice("im")), x = logScale(...range()), y = (p) => TOP + (height - TOP - BOTTOM) * (1 - p);
    const like = (e) => chosen && e.width_m === chosen.width_m && e.height_m === chosen.height_m;  // but for its friction
    const several = unique(shown.filter(like).map((e) => e.mu_k)).length > 1;
    let drawing = frame(height, x, y, word.symbol + (word.unit === "1" ? "" : ` (${word.unit})`));
    const names = [], table = [["id", "friction_mu", choice("im"), "probability", "lower", "upper", "n"]];
    const last = ({points}) => points[points.length - 1];
    const order = shown.slice().sort((a, b) => like(a) - like(b));  // those in colour lie on top
    order.forEach((entry) => {
      const curve = curveOf(entry.at), colour = like(entry) ? colours[shown.filter(like).indexOf(entry) % colours.length] : "#c3c8cf", isChosen = chosen && entry.at === chosen.at;
      if (!curve || !curve.points.length) return;
      const line = trace(curve);
      if (isChosen) drawing += `<path class="band" fill="${colour}" d="${path(line.map((p) => [x(p[IM]), y(p[HIGH])]).concat(line.slice().reverse().map((p) => [x(p[IM]), y(p[LOW])])))}Z"/>`;
      drawing += `<path class="curve${isChosen ? " chosen" : ""}" stroke="${colour}" d="${path(line.map((p) => [x(p[IM]), y(p[P])]))}"/>`;
      for (const p of curve.points) {
        drawing += `<circle class="dot" cx="${x(p[IM]).toFixed(1)}" cy="${y(p[P]).toFixed(1)}" r="${isChosen ? 4.5 : 2.5}" fill="${colour}"><title>${escape(entry.id)}: ${word.symbol} ${text(p[IM])}${unit(word)}, P = ${share(p[P])} [${share(p[LOW])}, ${share(p[HIGH])}], ${p[N]} samples</title></circle>`;
        table.push([entry.id, entry.mu_k, p[IM], p[P], p[LOW], p[HIGH], p[N]]);
      }
      if (like(entry)) names.push({y: y(last(curve)[P]), colour, words: several ? "μ = " + text(entry.mu_k) : entry.id, bold: isChosen});
    });
    if (chosen && chosen.reference_source && chosen.reference_intensity === choice("im") && chosen.reference_demand === choice("demand")) {
      const line = [];
      for (let k = 0; k <= 60; ++k) {
        const im = x.back(LEFT + (WIDTH - LEFT - RIGHT) * k / 60), p = phi(Math.log(im / chosen.reference_median) / chosen.reference_dispersion);
        line.push([x(im), y(p)]);
        table.push([chosen.reference_id, "", Number(im.toPrecision(6)), Number(p.toPrecision(6)), "", "", ""]);
      }
      drawing += `<path class="theirs" d="${path(line)}"/>`;
      names.push({y: line[60][1], colour: "#1d2430", words: chosen.reference_id, bold: false});
    }
    const here = intensity(), p = chosen ? at(curveOf(chosen.at), here) : null;
    drawing += `<line class="rule" style="stroke:#1d2430;stroke-dasharray:2 3" x1="${x(here)}" x2="${x(here)}" y1="${TOP}" y2="${height - BOTTOM}"/>` + labels(names);
    const finding = p ? `${chosen.id}: P(${event()}) = ${share(p[0])} (${share(p[1])} to ${share(p[2])}) at ${word.symbol} = ${text(here)}${unit(word)}` : `${choice("class")}: P(${event()})`;
    const figure = show("curves", height, drawing, finding, `Probability over ${word.symbol}${word.summary ? ` (${word.summary})` : ""}: in bold the entry that is chosen, with its band; in colour the same equipment on other frictions; in grey the rest of its class; dashed somebody else's fragility of it. ${chosen && curveOf(chosen.at) ? `${chosen.id} is ${ruleOf(curveOf(chosen.at))}, as by freestand query. ` : ""}Move over it for values.`, table);
    const svg = figure.querySelector("svg");
    svg.addEventListener("mousemove", (move) => {
      const box = svg.getBoundingClientRect(), im = x.back((move.clientX - box.left) * WIDTH / box.width);
      const values = shown.filter(like).map((entry) => [entry.id, at(curveOf(entry.at), im)]).filter(([, p]) => p);
      figure.querySelector(".readout").textContent = values.length ? `${word.symbol} = ${text(im)}${unit(word)}: ` + values.map(([id, p]) => `${id} ${share(p[0])} [${share(p[1])}, ${share(p[2])}]`).join("; ") : "";
    });
  }

  // Rows of dots with bars, one a row: [label, value, low, high, colour, title, bold]; on a scale that is given.
  function dots(rows, x, height) {
    return rows.map(([label, marks], i) => {
      const y = TOP + 11 + 22 * i;
      return `<line class="rule" x1="${LEFT + 130}" x2="${WIDTH - 30}" y1="${y}" y2="${y}"/><text x="${LEFT + 120}" y="${y + 4}" text-anchor="end">${escape(label)}</text>` +
        marks.map(({value, low, high, colour, words, shape}) => (low === null ? "" : `<line x1="${x(low)}" x2="${x(high)}" y1="${y}" y2="${y}" stroke="${colour}" stroke-width="4" opacity="0.3"/>`) +
          (shape === "diamond" ? `<path class="dot" fill="${colour}" d="M${x(value)} ${y - 7}l6 7l-6 7l-6 -7Z"><title>${escape(words)}</title></path>` :
            `<circle class="dot" cx="${x(value)}" cy="${y}" r="5" fill="${colour}"><title>${escape(words)}</title></circle>`)).join("");
    }).join("");
  }

  function drawClasses() {
    const word = of(data.intensities, choice("im")), im = intensity(), mu = Number(choice("mu")), floor = choice("floor");
    const rows = [], table = [["id", "class", "friction_mu", choice("im"), "probability", "lower", "upper"]];
    data.entries.forEach((entry, at_) => {
      if (entry.floor !== floor || Math.abs(entry.mu_k - mu) > 1e-9) return;
      const p = at(curveOf(at_), im);
      if (!p) return;
      table.push([entry.id, entry.class, entry.mu_k, Number(im.toPrecision(6)), ...p.map((v) => Number(v.toPrecision(6)))]);
      rows.push([entry.id.replace(new RegExp(`_(${entry.friction}|${entry.floor})$`), "").replace(new RegExp(`_${entry.friction}$`), ""), p, entry]);
    });
    rows.sort((a, b) => b[1][0] - a[1][0]);
    const height = TOP + 22 * Math.max(rows.length, 1) + BOTTOM, x = (p) => LEFT + 135 + (WIDTH - LEFT - 170) * p;
    const marks = rows.map(([label, p, entry]) => [label, [{value: p[0], low: p[1], high: p[2], colour: entry.class === choice("class") ? "#d55e00" : "#0072b2",
      words: `${entry.id} (${entry.class}): P = ${share(p[0])} [${share(p[1])}, ${share(p[2])}]`}]]);
    let drawing = dots(marks, x, height);
    for (const p of [0, 0.2, 0.4, 0.6, 0.8, 1]) drawing += `<text class="tick" x="${x(p)}" y="${height - BOTTOM + 19}" text-anchor="middle">${p}</text>`;
    drawing += `<text x="${x(0.5)}" y="${height - 8}" text-anchor="middle">${escape(`P(${event()}) at ${word.symbol} = ${text(im)}${unit(word)}`)}</text>`;
    const [first, final] = [rows[0], rows[rows.length - 1]];
    const finding = rows.length > 1 ? `At ${word.symbol} = ${text(im)}${unit(word)} and μ = ${text(mu)}, P(${event()}) ${share(final[1][0]) === share(first[1][0]) ? `is ${share(first[1][0])} for all ${rows.length} entries` : `goes from ${share(final[1][0])} (${final[0]}) to ${share(first[1][0])} (${first[0]})`}` :
      rows.length ? `Only ${rows[0][0]} has this friction on this floor` : "No entry was swept there: choose another intensity";
    show("classes", height, drawing, finding, "All entries with the chosen friction on the chosen floor, at the chosen intensity, with their bands; those of the chosen class in orange.", table);
  }

  // Where half go beyond the capacity: by the lognormal where it may be used, else where the points first reach 1/2.
  function medianOf(curve) {
    if (!curve) return null;
    if (curve.family === "lognormal") return curve.median >= curve.im_least && curve.median <= curve.im_most ? curve.median : null;
    const next = curve.points.findIndex((p) => p[P] >= 0.5);
    if (next < 1) return null;
    const [a, b] = [curve.points[next - 1], curve.points[next]];
    return Number((a[IM] + (b[IM] - a[IM]) * (0.5 - a[P]) / (b[P] - a[P])).toPrecision(6));
  }

  // Ours beside somebody else's: medians of each reference's own demand and intensity.
  function drawReferences() {
    if (!document.getElementById("references")) return;
    const floor = choice("floor"), entries = data.entries.map((e, i) => ({...e, at: i})).filter((e) => e.reference_source && e.floor === floor);
    const frictions = unique(entries.map((e) => e.mu_k)).sort((a, b) => a - b);
    const table = [["reference", "id", "floor", "friction_mu", "median", "median_by", "median_se", "dispersion", "reference_median", "reference_dispersion"]];
    const rows = unique(entries.map((e) => e.reference_id)).map((id) => {
      const mine = entries.filter((e) => e.reference_id === id), first = mine[0];
      const marks = [{value: first.reference_median, low: first.reference_median * Math.exp(-first.reference_dispersion), high: first.reference_median * Math.exp(first.reference_dispersion),
        colour: "#1d2430", words: `${id}: median ${text(first.reference_median)}, dispersion ${text(first.reference_dispersion)}`, shape: "diamond"}];
      for (const e of mine) {
        const c = data.curves.find((one) => one.entry === e.at && one.im === e.reference_intensity && one.demand === e.reference_demand && (e.reference_capacity === null || one.capacity === e.reference_capacity));
        const median = medianOf(c), fitted = median !== null && c.family === "lognormal";
        table.push([id, e.id, e.floor, e.mu_k, median, median === null ? "" : c.family, fitted ? c.median_se : null, fitted ? c.dispersion : null, e.reference_median, e.reference_dispersion]);
        if (median !== null) marks.push({value: median, low: null, high: null, colour: colours[frictions.indexOf(e.mu_k) % colours.length],
          words: fitted ? `${e.id}: median ${text(median)} ± ${text(c.median_se, 2)}, dispersion ${text(c.dispersion)}` : `${e.id}: half at ${text(median)}, no lognormal`});
      }
      return [(first.description.split(":")[0] || id).slice(0, 34), marks];
    });
    const values = rows.flatMap(([, marks]) => marks.flatMap((m) => [m.value, m.low, m.high])).filter((v) => v > 0);
    const [low, high] = [Math.min(...values) / 1.1, Math.max(...values) * 1.1], height = TOP + 22 * rows.length + BOTTOM + 18;
    const x = (v) => LEFT + 135 + (WIDTH - LEFT - 170) * Math.log(v / low) / Math.log(high / low);
    let drawing = dots(rows, x, height);
    for (const v of ticks(low, high)) drawing += `<text class="tick" x="${x(v)}" y="${height - BOTTOM - 2}" text-anchor="middle">${text(v)}</text>`;
    const word = entries.length ? of(data.intensities, entries[0].reference_intensity) : null;
    drawing += `<text x="${x(Math.sqrt(low * high))}" y="${height - 26}" text-anchor="middle">${escape(`median ${word ? word.symbol + " (" + word.unit + ")" : ""} of ${entries.length ? entries[0].reference_demand.replace("_", " ") : ""}`)}</text>`;
    let place = LEFT;
    for (const [words, colour] of [["theirs, with one dispersion", "#1d2430"], ...frictions.map((mu, i) => ["ours, μ = " + text(mu), colours[i % colours.length]])]) {
      drawing += `<circle cx="${place}" cy="${height - 6}" r="5" fill="${colour}"/><text x="${place + 10}" y="${height - 2}">${words}</text>`;
      place += 200;
    }
    const ratios = rows.map(([, marks]) => marks.slice(1).map((m) => m.value / marks[0].value)).flat();
    const missing = rows.filter(([, marks]) => marks.length < 1 + frictions.length).length;
    const finding = ratios.length ? `Ours are ${text(Math.min(...ratios), 2)} to ${text(Math.max(...ratios), 2)} times theirs${floor ? ` on floor ${floor}` : ""}${missing ? `; ${missing} of ${rows.length} do not reach their median within what was swept at some friction` : ""}` : "None of ours reaches its median within what was swept";
    show("references", height, drawing, finding, `Medians beside those of ${unique(entries.map((e) => e.reference_source)).join(", ")}. Choose another floor above to see what it changes.`, table);
  }

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
      const c = curveOf(e.at), fitted = c && c.median !== null;
      return `<tr data-at="${e.at}" class="${chosen && e.at === chosen.at ? "chosen" : ""}"><td class="text">${escape(e.id)}</td><td>${text(e.width_m)}</td><td>${text(e.height_m)}</td><td>${text(e.mass_kg)}</td><td>${text(e.mu_k)}</td>` +
        `<td>${fitted ? `${text(c.median)} ± ${text(c.median_se, 2)}` : "–"}</td><td>${fitted ? `${text(c.dispersion)} ± ${text(c.dispersion_se, 2)}` : "–"}</td>` +
        `<td class="text">${c ? (c.family === "lognormal" ? `lognormal, off by at most ${text(c.off_by, 2)}` : c.family === "not_refuted" ? `by its points; a lognormal is not refuted, may be off by ${text(c.off_by, 2)}` : "by its points") : ""}</td><td>${e.samples}</td><td>${e.version}</td><td class="text">${escape(e.description)}</td><td class="text">${escape(e.source)}</td></tr>`;
    }).join("");
    hideEmpty(body);
    for (const row of body.rows) row.addEventListener("click", () => { picked = Number(row.dataset.at); form.elements.mu.value = data.entries[picked].mu_k; draw(); });
  }

  let picked = null;
  function draw() {
    fillAll();
    const shown = ofClass().filter((e) => e.floor === choice("floor"));
    const chosen = shown.find((e) => e.at === picked) ?? shown.find((e) => Math.abs(e.mu_k - Number(choice("mu"))) < 1e-9) ?? shown[0];
    drawReferences();
    drawCurves(chosen, shown);
    drawClasses();
    fillTable(chosen, shown);
    const state = new URLSearchParams(["class", "mu", "floor", "demand", "capacity", "im", "at"].map((name) => [name, choice(name)]));
    history.replaceState(null, "", "#" + state);
  }
  form.addEventListener("input", (change) => { if (change.target.name !== "at") picked = null; draw(); });
  form.addEventListener("submit", (event) => event.preventDefault());
  draw();
})();
