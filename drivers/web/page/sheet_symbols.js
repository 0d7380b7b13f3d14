// One symbol for each kind of site: they differ by shape, and by colours that most colour-blind
// people tell apart.

export const SITE_COLOURS = {
  ground: '#0d1117',
  open: '#8b97a5',
  missing: '#4a5563',
  plugged: '#e58fd0',
  visited: '#6cc4ff',
  verified: '#2f81f7',
  contradicted: '#e8590c',
};

/** Below this radius only dots are told apart. */
const SMALL = 3;

/** Draws a site about (x, y) with a radius r, in a context of canvas. */
export function drawSite(ctx, kind, x, y, r) {
  const colour = SITE_COLOURS[kind];
  ctx.fillStyle = colour;
  ctx.strokeStyle = colour;
  if (r < SMALL) {
    const half = kind === 'open' || kind === 'missing' ? r * 0.8 : r * 1.2;
    if (kind !== 'missing') {
      ctx.fillRect(x - half, y - half, 2 * half, 2 * half);
    }
    return;
  }
  ctx.lineWidth = Math.max(1, r * 0.16);
  ctx.beginPath();
  if (kind === 'missing') {
    ctx.moveTo(x - r * 0.3, y - r * 0.3);
    ctx.lineTo(x + r * 0.3, y + r * 0.3);
    ctx.moveTo(x - r * 0.3, y + r * 0.3);
    ctx.lineTo(x + r * 0.3, y - r * 0.3);
    ctx.stroke();
    return;
  }
  if (kind === 'plugged') {
    ctx.rect(x - r * 0.8, y - r * 0.8, r * 1.6, r * 1.6);
    ctx.moveTo(x - r * 0.8, y - r * 0.8);
    ctx.lineTo(x + r * 0.8, y + r * 0.8);
    ctx.moveTo(x - r * 0.8, y + r * 0.8);
    ctx.lineTo(x + r * 0.8, y - r * 0.8);
    ctx.stroke();
    return;
  }
  ctx.arc(x, y, r * 0.9, 0, 2 * Math.PI);
  if (kind === 'open') {
    ctx.stroke();
    return;
  }
  if (kind === 'visited') {
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(x, y, r * 0.4, 0, 2 * Math.PI);
    ctx.fill();
    return;
  }
  ctx.fill();
  ctx.strokeStyle = '#ffffff';
  ctx.lineWidth = Math.max(1.5, r * 0.26);
  ctx.beginPath();
  if (kind === 'verified') {
    ctx.moveTo(x - r * 0.42, y + r * 0.02);
    ctx.lineTo(x - r * 0.1, y + r * 0.38);
    ctx.lineTo(x + r * 0.46, y - r * 0.36);
  } else {
    ctx.moveTo(x - r * 0.5, y);
    ctx.lineTo(x + r * 0.5, y);
  }
  ctx.stroke();
}

const number = (value) => String(Math.round(value * 100) / 100);

/** The same symbol as SVG, about (x, y). */
export function siteSvg(kind, x, y, r) {
  const colour = SITE_COLOURS[kind];
  const at = (dx, dy) => `${number(x + dx * r)} ${number(y + dy * r)}`;
  const circle = (share, attributes) =>
    `<circle cx="${number(x)}" cy="${number(y)}" r="${number(r * share)}" ${attributes}/>`;
  const line = (d, stroke, width) =>
    `<path d="${d}" fill="none" stroke="${stroke}" stroke-width="${number(r * width)}"/>`;
  const outline = `fill="none" stroke="${colour}" stroke-width="${number(r * 0.16)}"`;
  const marks = {
    missing: () =>
      line(`M${at(-0.3, -0.3)}L${at(0.3, 0.3)}M${at(-0.3, 0.3)}L${at(0.3, -0.3)}`, colour, 0.16),
    open: () => circle(0.9, outline),
    plugged: () =>
      line(
        `M${at(-0.8, -0.8)}L${at(0.8, -0.8)}L${at(0.8, 0.8)}L${at(-0.8, 0.8)}ZL${at(0.8, 0.8)}M${at(-0.8, 0.8)}L${at(0.8, -0.8)}`,
        colour,
        0.16,
      ),
    visited: () => circle(0.9, outline) + circle(0.4, `fill="${colour}"`),
    verified: () =>
      circle(0.9, `fill="${colour}"`) +
      line(`M${at(-0.42, 0.02)}L${at(-0.1, 0.38)}L${at(0.46, -0.36)}`, '#ffffff', 0.26),
    contradicted: () =>
      circle(0.9, `fill="${colour}"`) + line(`M${at(-0.5, 0)}L${at(0.5, 0)}`, '#ffffff', 0.26),
  };
  return marks[kind]();
}
