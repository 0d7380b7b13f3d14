// The marks over a picture. No two kinds differ by colour alone; each has a dark rim, so that it
// shows on bright and dark.

export const COLOURS = {
  row: '#ff5a4d',
  column: '#ffe14d',
  tool: '#1f6feb',
  pale: '#e8f1ff',
  good: '#4be08a',
  rejected: '#ff9d3b',
  plug: '#ff7de9',
  window: '#3fd0c9',
  claim: '#ff6a3d',
};

/** Adds four strokes to the path, from `inner` to `outer` px away from a place. */
export function crossHair(ctx, x, y, inner, outer) {
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ]) {
    ctx.moveTo(x + dx * inner, y + dy * inner);
    ctx.lineTo(x + dx * outer, y + dy * outer);
  }
}
const RIM = '#000000';

/** Strokes what `path` lays out, with a dark rim below. */
function stroke(ctx, colour, width, path, dash = []) {
  for (const [style, wide] of [
    [RIM, width + 2.5],
    [colour, width],
  ]) {
    ctx.beginPath();
    path(ctx);
    ctx.setLineDash(dash);
    ctx.strokeStyle = style;
    ctx.lineWidth = wide;
    ctx.stroke();
  }
  ctx.setLineDash([]);
}

function cross(ctx, x, y, r) {
  ctx.moveTo(x - r, y);
  ctx.lineTo(x + r, y);
  ctx.moveTo(x, y - r);
  ctx.lineTo(x, y + r);
}

function diagonalCross(ctx, x, y, r) {
  ctx.moveTo(x - r, y - r);
  ctx.lineTo(x + r, y + r);
  ctx.moveTo(x - r, y + r);
  ctx.lineTo(x + r, y - r);
}

function arrow(ctx, colour, from, to, width) {
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const head = width * 3.2;
  const barb = (turn) => [
    to[0] - head * Math.cos(angle + turn),
    to[1] - head * Math.sin(angle + turn),
  ];
  stroke(ctx, colour, width, (path) => {
    path.moveTo(...from);
    path.lineTo(...to);
    path.moveTo(...barb(0.5));
    path.lineTo(...to);
    path.lineTo(...barb(-0.5));
  });
}

/** Text on a plate, its middle at (x, y), kept within the canvas. */
export function plate(
  ctx,
  text,
  x,
  y,
  { size = 16, colour = '#ffffff', ground = '#000000', edge = null, view = null } = {},
) {
  ctx.font = `bold ${size}px "DejaVu Sans", Verdana, sans-serif`;
  ctx.textBaseline = 'middle';
  ctx.textAlign = 'center';
  const width = ctx.measureText(text).width + size * 0.7;
  const height = size * 1.45;
  if (view) {
    x = Math.min(
      Math.max(x, view.left + width / 2 + 2),
      view.left + view.width * view.scale - width / 2 - 2,
    );
    y = Math.min(
      Math.max(y, view.top + height / 2 + 2),
      view.top + view.height * view.scale - height / 2 - 2,
    );
  }
  ctx.fillStyle = ground;
  ctx.fillRect(x - width / 2, y - height / 2, width, height);
  if (edge) {
    ctx.strokeStyle = edge;
    ctx.lineWidth = 2;
    ctx.strokeRect(x - width / 2, y - height / 2, width, height);
  }
  ctx.fillStyle = colour;
  ctx.fillText(text, x, y + size * 0.05);
}

export function drawWindow(ctx, view, window, optimum) {
  const s = view.scale;
  if (window) {
    const [x, y] = view.toScreen(window.left - 0.5, window.top - 0.5);
    stroke(ctx, COLOURS.window, 1.5, (path) =>
      path.rect(x, y, window.width * s, window.height * s),
    );
  }
  if (optimum) {
    const [x, y] = view.toScreen(optimum.u, optimum.v);
    const r = 6;
    stroke(ctx, COLOURS.window, 1.5, (path) => {
      path.moveTo(x - r, y);
      path.lineTo(x, y - r);
      path.lineTo(x + r, y);
      path.lineTo(x, y + r);
      path.closePath();
    });
  }
}

function drawTubes(ctx, view, tubes) {
  const r = Math.max(5, 4.5 * view.scale);
  for (const [, , u, v, quality, plug] of tubes) {
    const [x, y] = view.toScreen(u, v);
    if (plug) {
      stroke(ctx, COLOURS.plug, 2, (path) => path.rect(x - r, y - r, 2 * r, 2 * r));
    } else if (quality > 0) {
      stroke(ctx, COLOURS.good, 1.6, (path) => cross(path, x, y, r));
    } else {
      stroke(ctx, COLOURS.rejected, 2, (path) => diagonalCross(path, x, y, r * 0.8));
    }
  }
}

/**
 * The primary tube with the row axis in red and the column axis in yellow, and its numbers at the
 * bottom.
 */
function drawPrimary(ctx, view, sighting) {
  const { primary, next_row: nextRow, next_column: nextColumn } = sighting;
  if (!primary) {
    return;
  }
  const from = view.toScreen(primary.u, primary.v);
  for (const [end, colour, letter] of [
    [nextRow, COLOURS.row, 'R'],
    [nextColumn, COLOURS.column, 'C'],
  ]) {
    if (!end) {
      continue;
    }
    const to = view.toScreen(end.u, end.v);
    const at = (share) => [
      from[0] + (to[0] - from[0]) * share,
      from[1] + (to[1] - from[1]) * share,
    ];
    arrow(ctx, colour, from, at(0.86), 3.5);
    plate(ctx, letter, ...at(1.02), { size: 14, colour, view });
  }
  ctx.beginPath();
  ctx.arc(...from, 5, 0, 2 * Math.PI);
  ctx.fillStyle = '#ffffff';
  ctx.fill();
  ctx.lineWidth = 1.5;
  ctx.strokeStyle = RIM;
  ctx.stroke();
  if (Number.isInteger(primary.row)) {
    const size = Math.max(16, 15 * view.scale);
    const y = view.top + view.height * view.scale - size;
    const x = view.left + size * 3;
    plate(ctx, `ROW ${primary.row}`, x, y, { size, colour: COLOURS.row, view });
    plate(ctx, `COL ${primary.column}`, x + size * 5.6, y, { size, colour: COLOURS.column, view });
  }
}

/**
 * The large blue cross-hair at the tube above the guidetube: whole and framed where vouched for,
 * broken where not.
 */
function drawTool(ctx, view, sighting, vouched) {
  const { tool, axis, around } = sighting;
  if (tool && typeof tool.u === 'number') {
    const [x, y] = view.toScreen(tool.u, tool.v);
    // The four tube-ends around it tell how far apart they stand here.
    const apart = (around || []).map((place) => {
      const [px, py] = view.toScreen(place.u, place.v);
      return Math.hypot(px - x, py - y);
    });
    const reach = apart.length
      ? (0.52 * apart.reduce((sum, each) => sum + each, 0)) / apart.length
      : 34 * view.scale;
    const long = reach * 2.4;
    for (const [style, width] of [
      ['#ffffff', 7],
      [COLOURS.tool, 4.5],
    ]) {
      ctx.beginPath();
      crossHair(ctx, x, y, reach, long);
      if (vouched) {
        ctx.moveTo(x + reach, y);
        ctx.arc(x, y, reach, 0, 2 * Math.PI);
      }
      ctx.setLineDash(vouched ? [] : [7, 7]);
      ctx.strokeStyle = style;
      ctx.lineWidth = width;
      ctx.stroke();
    }
    ctx.setLineDash([]);
    const size = Math.max(20, 20 * view.scale);
    plate(
      ctx,
      `${tool.row} / ${tool.column}${vouched ? '' : ' ?'}`,
      x + long * 0.75,
      y - long * 0.7,
      {
        size,
        ground: vouched ? '#0b3d91' : '#000000',
        colour: '#ffffff',
        edge: vouched ? '#ffffff' : COLOURS.tool,
        view,
      },
    );
  }
  if (axis) {
    const end = view.toScreen(axis.u, axis.v);
    if (tool && typeof tool.u === 'number') {
      const start = view.toScreen(tool.u, tool.v);
      if (Math.hypot(end[0] - start[0], end[1] - start[1]) > 14) {
        arrow(ctx, COLOURS.pale, start, end, 2.5);
      }
    }
    stroke(ctx, COLOURS.pale, 2, (path) => path.arc(...end, 6, 0, 2 * Math.PI));
  }
}

/** The sign of no entry on the tube that the robot claims and the box contradicts. */
export function drawContradiction(ctx, view, claim) {
  if (!claim || typeof claim.u !== 'number') {
    return;
  }
  const [x, y] = view.toScreen(claim.u, claim.v);
  const r = 15 * view.scale;
  ctx.beginPath();
  ctx.arc(x, y, r, 0, 2 * Math.PI);
  ctx.fillStyle = '#b83200';
  ctx.fill();
  ctx.lineWidth = 3;
  ctx.strokeStyle = '#ffffff';
  ctx.stroke();
  ctx.fillStyle = '#ffffff';
  ctx.fillRect(x - r * 0.6, y - r * 0.17, r * 1.2, r * 0.34);
  plate(ctx, `robot: ${claim.row} / ${claim.column}`, x, y + r + 16, {
    size: 16,
    edge: COLOURS.claim,
    view,
  });
}

/**
 * All that the box saw. `standing` says whether the tube above the guidetube may be shown, and
 * how.
 */
export function drawSighting(ctx, view, sighting, standing) {
  drawWindow(ctx, view, sighting.window, sighting.optimum);
  if (standing === 'unknown') {
    return;
  }
  drawTubes(ctx, view, sighting.tubes || []);
  if (standing !== 'none') {
    drawTool(ctx, view, sighting, standing === 'vouched');
  } else if (sighting.axis) {
    drawTool(ctx, view, { axis: sighting.axis }, false);
  }
  // The axes lie over the cross-hair, which begins at the same tube-end often enough.
  drawPrimary(ctx, view, sighting);
  if (sighting.claim && sighting.claim.verdict === 'contradicted') {
    drawContradiction(ctx, view, sighting.claim);
  }
}

/** A dot and the address where each tube of the window is expected. */
export function drawEstimates(ctx, view, estimates) {
  for (const [row, column, u, v] of estimates) {
    const [x, y] = view.toScreen(u, v);
    stroke(ctx, COLOURS.pale, 1.5, (path) => path.arc(x, y, 4, 0, 2 * Math.PI));
    plate(ctx, `${row}/${column}`, x, y + 14, { size: 11, view });
  }
}

/** From where each tube-end is expected to where it was measured, magnified. */
export function drawResiduals(ctx, view, tubes, estimates, magnified) {
  const expected = new Map(estimates.map(([row, column, u, v]) => [`${row},${column}`, [u, v]]));
  for (const [row, column, u, v] of tubes) {
    const place = expected.get(`${row},${column}`);
    if (place) {
      const from = view.toScreen(...place);
      arrow(
        ctx,
        COLOURS.column,
        from,
        [
          from[0] + (u - place[0]) * magnified * view.scale,
          from[1] + (v - place[1]) * magnified * view.scale,
        ],
        2,
      );
    }
  }
}

/** A place that a person chose, with what is said of it. */
export function drawChoice(ctx, view, { u, v }, text, bad = false) {
  const [x, y] = view.toScreen(u, v);
  const colour = bad ? COLOURS.claim : '#ffffff';
  stroke(ctx, colour, 3, (path) => path.arc(x, y, 13, 0, 2 * Math.PI));
  stroke(ctx, colour, 2, (path) => cross(path, x, y, bad ? 20 : 5));
  if (text) {
    plate(ctx, text, x, y - 30, { size: 18, edge: colour, view });
  }
}

/** Where the arrow keys are. */
export function drawCursor(ctx, view, { u, v }) {
  const [x, y] = view.toScreen(u, v);
  stroke(ctx, '#ffffff', 2, (path) => path.rect(x - 20, y - 20, 40, 40), [6, 5]);
}
