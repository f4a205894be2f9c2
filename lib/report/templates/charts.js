// A button for each figure with data: instead of the picture a chart whose values can be read under the pointer, and
// that is zoomed by dragging. Needs dygraphs.
"use strict";
(function () {
  // dygraphs takes one column of x for all lines.
  function columns(lines) {
    const at = new Map();
    lines.forEach(function (line, i) {
      line.points.forEach(function (p) {
        if (!at.has(p[0])) at.set(p[0], new Array(lines.length).fill(null));
        at.get(p[0])[i] = p[1];
      });
    });
    return Array.from(at, function (entry) { return [entry[0]].concat(entry[1]); })
      .sort(function (a, b) { return a[0] - b[0]; });
  }

  function names(lines) {
    const used = new Set();
    return lines.map(function (line) {
      let name = line.name || "line";
      for (let k = 2; used.has(name); ++k) name = (line.name || "line") + " " + k;
      used.add(name);
      return name;
    });
  }

  // The range of x with a margin; what dygraphs itself adds may pass zero on a logarithmic axis.
  function range(data) {
    const x = data.lines.flatMap(function (line) { return line.points.map(function (p) { return p[0]; }); }),
      low = Math.min.apply(null, x), high = Math.max.apply(null, x), margin = .03;
    if (data.xLog) {
      const factor = Math.max(Math.pow(high / low, margin), 1.01);
      return [low / factor, high * factor];
    }
    return [low - margin * (high - low), high + margin * (high - low)];
  }

  function tick(value) {
    const short = Number(value.toPrecision(3)), size = Math.abs(short);
    return size !== 0 && (size < 1e-3 || size >= 1e5) ? short.toExponential() : String(short);
  }

  function text(value) { return value === null || value === undefined ? "" : Number(value).toPrecision(4); }

  function draw(figure, data) {
    const box = document.createElement("div"), legend = document.createElement("div"),
      place = document.createElement("div");
    box.className = "interactive";
    legend.className = "legend";
    box.append(place, legend);
    figure.prepend(box);
    const labels = names(data.lines), series = {};
    data.lines.forEach(function (line, i) {
      series[labels[i]] = { color: line.colour, strokePattern: line.dashed ? Dygraph.DASHED_LINE : null };
    });
    const number = { valueFormatter: text, axisLabelFormatter: tick };
    figure.chart = new Dygraph(place, columns(data.lines), {
      labels: [data.x].concat(labels), series: series, xlabel: data.x, ylabel: data.y, labelsDiv: legend,
      legend: "always", connectSeparatedPoints: true, dateWindow: range(data), yRangePad: 12, yLabelWidth: 24,
      drawPoints: true, pointSize: 3, strokeWidth: 1.6, highlightCircleSize: 6, highlightSeriesOpts: { strokeWidth: 3 }, logscale: data.yLog,
      axes: { x: Object.assign({ logscale: data.xLog }, number), y: Object.assign({ axisLabelWidth: 70 }, number) }
    });
  }

  document.querySelectorAll("script.chart-data").forEach(function (element) {
    const figure = element.parentElement, picture = figure.querySelector("svg"),
      button = document.createElement("button");
    button.type = "button";
    button.textContent = "Values and zoom";
    button.title = "Values under the pointer; drag to zoom, double-click to reset";
    button.addEventListener("click", function () {
      if (!figure.chart) draw(figure, JSON.parse(element.textContent));
      const box = figure.querySelector(".interactive"), is_shown = picture.style.display === "none";
      picture.style.display = is_shown ? "" : "none";
      box.style.display = is_shown ? "none" : "";
      button.textContent = is_shown ? "Values and zoom" : "Picture";
      if (!is_shown) figure.chart.resize();
    });
    figure.append(button);
  });
})();
