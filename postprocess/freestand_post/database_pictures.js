// The curves of a class, and all entries at one intensity.
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
      table.push([chosen.reference_id, "", im, p, "", "", ""]);
    }
    drawing += `<path class="theirs" d="${path(line)}"/>`;
    names.push({y: line[60][1], colour: "#1d2430", words: chosen.reference_id, bold: false, dashed: true});
  }
  const here = intensity(), p = chosen ? at(curveOf(chosen.at), here) : null;
  drawing += `<line class="rule" style="stroke:#1d2430;stroke-dasharray:2 3" x1="${x(here)}" x2="${x(here)}" y1="${TOP}" y2="${height - BOTTOM}"/>`;
  const told = narrow ? legend(names.map(({colour, words, dashed}) => [(a, b) => `<line x1="${a - 8}" x2="${a + 8}" y1="${b}" y2="${b}" stroke="${colour}" stroke-width="${dashed ? 1.6 : 3}"${dashed ? ' stroke-dasharray="6 4"' : ""}/>`, words]), height) : {drawing: labels(names), height: 0};
  const finding = p ? `${chosen.id}: P(${event()}) = ${share(p[0])} (${share(p[1])} to ${share(p[2])}) at ${word.symbol} = ${text(here)}${unit(word)}` : `${choice("class")}: P(${event()})`;
  const figure = show("curves", height + told.height, drawing + told.drawing, finding, `Probability over ${word.symbol}${word.summary ? ` (${word.summary})` : ""}: in bold the entry that is chosen, with its band; in colour the same equipment on other frictions; in grey the rest of its class; dashed somebody else's fragility of it. ${chosen && curveOf(chosen.at) ? `${chosen.id} is ${ruleOf(curveOf(chosen.at))}, as by freestand query. ` : ""}Move over it for values.`, table);
  const svg = figure.querySelector("svg");
  svg.addEventListener("mousemove", (move) => {
    const box = svg.getBoundingClientRect(), im = x.back((move.clientX - box.left) * WIDTH / box.width);
    const values = shown.filter(like).map((entry) => [entry.id, at(curveOf(entry.at), im)]).filter(([, p]) => p);
    figure.querySelector(".readout").textContent = values.length ? `${word.symbol} = ${text(im)}${unit(word)}: ` + values.map(([id, p]) => `${id} ${share(p[0])} [${share(p[1])}, ${share(p[2])}]`).join("; ") : "";
  });
}

function drawClasses() {
  const word = of(data.intensities, choice("im")), im = intensity(), mu = Number(choice("mu")), floor = choice("floor");
  const rows = [], table = [["id", "class", "friction_mu", choice("im"), "probability", "lower", "upper"]];
  data.entries.forEach((entry, at_) => {
    if (entry.floor !== floor || Math.abs(entry.mu_k - mu) > 1e-9) return;
    const p = at(curveOf(at_), im);
    if (!p) return;
    table.push([entry.id, entry.class, entry.mu_k, im, ...p]);
    rows.push([entry.id.replace(new RegExp(`_(${entry.friction}|${entry.floor})$`), "").replace(new RegExp(`_${entry.friction}$`), ""), p, entry]);
  });
  rows.sort((a, b) => b[1][0] - a[1][0]);
  const place = rowsOf(rows.map(([label]) => label), 22), height = Math.max(place.end, TOP + 22) + BOTTOM, x = (p) => place.from + (place.to - place.from) * p;
  let drawing = place.drawing;
  rows.forEach(([, p, entry], i) => {
    const y = place.top(i) + 11, colour = entry.class === choice("class") ? "#d55e00" : "#0072b2";
    drawing += `<line x1="${x(p[1])}" x2="${x(p[2])}" y1="${y}" y2="${y}" stroke="${colour}" stroke-width="4" opacity="0.3"/><circle class="dot" cx="${x(p[0])}" cy="${y}" r="5" fill="${colour}"><title>${escape(`${entry.id} (${entry.class}): P = ${share(p[0])} [${share(p[1])}, ${share(p[2])}]`)}</title></circle>`;
  });
  for (const p of [0, 0.2, 0.4, 0.6, 0.8, 1]) drawing += `<text class="tick" x="${x(p)}" y="${height - BOTTOM + 19}" text-anchor="middle">${p}</text>`;
  drawing += `<text x="${x(0.5)}" y="${height - 8}" text-anchor="middle">${escape(`P(${event()}) at ${word.symbol} = ${text(im)}${unit(word)}`)}</text>`;
  const [first, final] = [rows[0], rows[rows.length - 1]];
  const finding = rows.length > 1 ? `At ${word.symbol} = ${text(im)}${unit(word)} and μ = ${text(mu)}, P(${event()}) ${share(final[1][0]) === share(first[1][0]) ? `is ${share(first[1][0])} for all ${rows.length} entries` : `goes from ${share(final[1][0])} (${final[0]}) to ${share(first[1][0])} (${first[0]})`}` :
    rows.length ? `Only ${rows[0][0]} has this friction on this floor` : "No entry has a curve there: too few samples, or another intensity than was swept";
  show("classes", height, drawing, finding, "All entries with the chosen friction on the chosen floor, at the chosen intensity, with their bands; those of the chosen class in orange.", table);
}

