// The sheet as a file: SVG, PNG, CSV.
import { KINDS } from './sheet_sites.js';
import { drawSite, SITE_COLOURS, siteSvg } from './sheet_symbols.js';

const MOST_PX = 4000;

const escaped = (text) =>
  String(text).replace(
    /[&<>"]/g,
    (sign) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[sign],
  );

function frame(sites) {
  const { left, right, bottom, top } = sites.bounds;
  const edge = sites.pitch;
  return {
    left: left - edge,
    top: top + edge,
    width: right - left + 2 * edge,
    height: top - bottom + 2 * edge,
  };
}

/** One unit is 1 mm; x to the right, y up, as in the sheet frame. */
export function sheetSvg(sites, { path }) {
  const { left, top, width, height } = frame(sites);
  const size = (value) => Math.round(value * 100) / 100;
  const lines = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${size(width)}mm" height="${size(height)}mm" viewBox="0 0 ${size(width)} ${size(height)}">`,
    `<title>${escaped(sites.sheet.name || 'Tubesheet')}</title>`,
    `<rect width="100%" height="100%" fill="${SITE_COLOURS.ground}"/>`,
  ];
  for (const site of sites.list) {
    lines.push(
      `<g>${siteSvg(site.kind, site.x - left, top - site.y, sites.pitch * 0.4)}<title>${site.row}/${site.column} ${site.kind}</title></g>`,
    );
  }
  if (path.length > 1) {
    const points = path.map(([x, y]) => `${size(x - left)},${size(top - y)}`).join(' ');
    lines.push(
      `<polyline points="${points}" fill="none" stroke="#ffe14d" stroke-width="${size(sites.pitch * 0.06)}"/>`,
    );
  }
  lines.push('</svg>');
  return lines.join('\n');
}

/** Resolves to a PNG of the whole sheet, at most 4000 px wide or high. */
export function sheetPng(sites, { path }) {
  const { left, top, width, height } = frame(sites);
  const scale = Math.min(MOST_PX / Math.max(width, height), 4);
  const canvas = document.createElement('canvas');
  canvas.width = Math.ceil(width * scale);
  canvas.height = Math.ceil(height * scale);
  const ctx = canvas.getContext('2d');
  ctx.fillStyle = SITE_COLOURS.ground;
  ctx.fillRect(0, 0, canvas.width, canvas.height);
  for (const kind of KINDS) {
    for (const site of sites.list) {
      if (site.kind === kind) {
        drawSite(
          ctx,
          kind,
          (site.x - left) * scale,
          (top - site.y) * scale,
          sites.pitch * scale * 0.4,
        );
      }
    }
  }
  ctx.beginPath();
  for (const [x, y] of path) {
    ctx.lineTo((x - left) * scale, (top - y) * scale);
  }
  ctx.strokeStyle = '#ffe14d';
  ctx.lineWidth = 2;
  ctx.stroke();
  return new Promise((done) => canvas.toBlob(done, 'image/png'));
}

/** One row a site: row,column,x_mm,y_mm,built,state,count,last_s. */
export function sheetCsv(sites) {
  const rows = sites.list.map((site) =>
    [
      site.row,
      site.column,
      site.x.toFixed(4),
      site.y.toFixed(4),
      site.built,
      site.kind === site.built ? '' : site.kind,
      site.count,
      site.last === null || site.last === undefined ? '' : Number(site.last).toFixed(6),
    ].join(','),
  );
  return `row,column,x_mm,y_mm,built,state,count,last_s\n${rows.join('\n')}\n`;
}
