// Draws a sheet of 11,000 tubes at 60 pictures a second: tiles drawn once and shifted, marks over
// them.
import { make } from './dom.js';
import { crossHair } from './marks.js';
import { drawSite, SITE_COLOURS } from './sheet_symbols.js';

const TILE = 512; // px of the device
const MOST_TILES = 96; // 1 MiB each
const TILE_BUDGET_MS = 5; // of each picture's 16 for tiles not drawn yet
const LABEL_PITCH = 46; // CSS px between tubes from which on there is room for addresses

export class SheetMap {
  constructor(label) {
    this.canvas = make('canvas', { 'aria-hidden': 'true' });
    this.host = make(
      'div',
      { class: 'sheet-map', tabindex: '0', role: 'application', 'aria-label': label },
      this.canvas,
    );
    this.sites = null;
    this.tiles = new Map();
    this.scale = 1; // CSS px a mm
    this.x = 0; // mm in the middle of the canvas
    this.y = 0;
    this.marks = { path: [], now: null, found: null };
    this.waiting = false;
    this.pointers = new Map();
    this.fitted = false;
    this.drawMs = [];
    new ResizeObserver(() => (this.fitted ? this.ask() : this.all())).observe(this.host);
    this.listen();
  }

  setSites(sites) {
    this.sites = sites;
    this.tiles.clear();
    this.all();
  }

  changed(sites) {
    for (const [key, tile] of this.tiles) {
      const reach = sites.some((site) => this.touches(tile, site));
      if (reach) {
        this.tiles.delete(key);
      }
    }
    this.ask();
  }

  touches(tile, { x, y }) {
    const { pitch } = this.sites;
    return (
      x > tile.left - pitch &&
      x < tile.left + tile.size + pitch &&
      y < tile.top + pitch &&
      y > tile.top - tile.size - pitch
    );
  }

  // The view.

  all() {
    if (!this.sites || this.host.clientWidth === 0 || !this.sites.list.length) {
      return;
    }
    const { left, right, bottom, top } = this.sites.bounds;
    const { pitch } = this.sites;
    this.x = (left + right) / 2;
    this.y = (bottom + top) / 2;
    this.scale = Math.min(
      this.host.clientWidth / (right - left + 2 * pitch),
      this.host.clientHeight / (top - bottom + 2 * pitch),
    );
    this.least = this.scale / 2;
    this.fitted = true;
    this.ask();
  }

  /** Zooms by a factor about a place of the canvas. */
  zoom(factor, px = this.host.clientWidth / 2, py = this.host.clientHeight / 2) {
    const x = this.x + (px - this.host.clientWidth / 2) / this.scale;
    const y = this.y - (py - this.host.clientHeight / 2) / this.scale;
    this.scale = Math.min(Math.max(this.scale * factor, this.least || 0.01), 8);
    this.x = x - (px - this.host.clientWidth / 2) / this.scale;
    this.y = y + (py - this.host.clientHeight / 2) / this.scale;
    this.ask();
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.ask();
  }

  goTo(site) {
    this.x = site.x;
    this.y = site.y;
    this.scale = Math.max(this.scale, 60 / this.sites.pitch);
    this.marks.found = site;
    this.ask();
  }

  listen() {
    const at = (event) => {
      const box = this.host.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.host.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...at(event));
      },
      { passive: false },
    );
    this.host.addEventListener('pointerdown', (event) => {
      this.host.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, at(event));
      this.moved = 0;
    });
    this.host.addEventListener('pointermove', (event) => {
      const before = this.pointers.get(event.pointerId);
      if (!before) {
        return;
      }
      const now = at(event);
      const others = [...this.pointers]
        .filter(([id]) => id !== event.pointerId)
        .map(([, place]) => place);
      this.moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
      if (others.length) {
        const [other] = others;
        const apart = (place) => Math.max(10, Math.hypot(place[0] - other[0], place[1] - other[1]));
        this.zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
      } else {
        this.pan(now[0] - before[0], now[1] - before[1]);
      }
      this.pointers.set(event.pointerId, now);
    });
    const end = (event) => {
      const place = this.pointers.get(event.pointerId);
      this.pointers.delete(event.pointerId);
      if (event.type === 'pointerup' && place && this.moved < 6 && this.sites) {
        const site = this.sites.at(
          this.x + (place[0] - this.host.clientWidth / 2) / this.scale,
          this.y - (place[1] - this.host.clientHeight / 2) / this.scale,
        );
        this.marks.found = site;
        this.host.dispatchEvent(new CustomEvent('site', { detail: site }));
        this.ask();
      }
    };
    this.host.addEventListener('pointerup', end);
    this.host.addEventListener('pointercancel', end);
    this.host.addEventListener('keydown', (event) => {
      const moves = {
        ArrowLeft: [80, 0],
        ArrowRight: [-80, 0],
        ArrowUp: [0, 80],
        ArrowDown: [0, -80],
      };
      if (moves[event.key]) {
        this.pan(...moves[event.key]);
      } else if (event.key === '+' || event.key === '=') {
        this.zoom(1.4);
      } else if (event.key === '-') {
        this.zoom(1 / 1.4);
      } else if (event.key === '0' || event.key === 'Home') {
        this.all();
      } else {
        return;
      }
      event.preventDefault();
    });
  }

  // Drawing.

  ask() {
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame(() => {
        this.waiting = false;
        this.draw();
      });
    }
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!this.sites || width === 0) {
      return;
    }
    const begun = performance.now();
    const ratio = window.devicePixelRatio || 1;
    if (
      this.canvas.width !== Math.round(width * ratio) ||
      this.canvas.height !== Math.round(height * ratio)
    ) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const ctx = this.canvas.getContext('2d', { alpha: false });
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = SITE_COLOURS.ground;
    ctx.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.drawTiles(ctx, ratio, begun);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawLabels(ctx);
    this.drawMarks(ctx);
    this.drawMs.push(performance.now() - begun);
    if (this.drawMs.length > 240) {
      this.drawMs.shift();
    }
  }

  /**
   * Tiles are drawn at the next power of two above the scale, so that they are only ever made
   * smaller.
   */
  drawTiles(ctx, ratio, begun) {
    const level = Math.ceil(Math.log2(this.scale * ratio));
    const size = TILE / 2 ** level;
    const halfWidth = this.host.clientWidth / 2 / this.scale;
    const halfHeight = this.host.clientHeight / 2 / this.scale;
    const { bounds, pitch } = this.sites;
    const from = (value) => Math.floor(value / size);
    const columns = [
      from(Math.max(this.x - halfWidth, bounds.left - pitch)),
      from(Math.min(this.x + halfWidth, bounds.right + pitch)),
    ];
    const rows = [
      from(Math.max(this.y - halfHeight, bounds.bottom - pitch)),
      from(Math.min(this.y + halfHeight, bounds.top + pitch)),
    ];
    const wide = size * this.scale * ratio;
    let missing = false;
    for (let row = rows[0]; row <= rows[1]; row += 1) {
      for (let column = columns[0]; column <= columns[1]; column += 1) {
        const px = ((column * size - this.x) * this.scale + this.host.clientWidth / 2) * ratio;
        const py = ((this.y - (row + 1) * size) * this.scale + this.host.clientHeight / 2) * ratio;
        const inTime = performance.now() - begun < TILE_BUDGET_MS;
        const tile = this.tile(level, column, row, inTime);
        if (tile) {
          ctx.drawImage(tile.canvas, px, py, wide, wide);
        } else {
          missing = true;
          this.drawCoarse(ctx, level, column, row, px, py, wide);
        }
      }
    }
    if (missing) {
      this.ask();
    }
  }

  /** What a coarser level has of a tile that there was no time for. */
  drawCoarse(ctx, level, column, row, px, py, wide) {
    for (let up = 1; up <= 6; up += 1) {
      const parts = 2 ** up;
      const tile = this.tiles.get(
        `${level - up},${Math.floor(column / parts)},${Math.floor(row / parts)}`,
      );
      if (tile) {
        const part = TILE / parts;
        const left = column - Math.floor(column / parts) * parts;
        const top = parts - 1 - (row - Math.floor(row / parts) * parts);
        ctx.drawImage(tile.canvas, left * part, top * part, part, part, px, py, wide, wide);
        return;
      }
    }
  }

  tile(level, column, row, mayDraw) {
    const key = `${level},${column},${row}`;
    const known = this.tiles.get(key);
    if (known) {
      this.tiles.delete(key);
      this.tiles.set(key, known);
      return known;
    }
    if (!mayDraw) {
      return null;
    }
    const size = TILE / 2 ** level;
    const tile = {
      left: column * size,
      top: (row + 1) * size,
      size,
      canvas: document.createElement('canvas'),
    };
    tile.canvas.width = TILE;
    tile.canvas.height = TILE;
    const ctx = tile.canvas.getContext('2d', { alpha: false });
    ctx.fillStyle = SITE_COLOURS.ground;
    ctx.fillRect(0, 0, TILE, TILE);
    const scale = 2 ** level;
    for (const site of this.sites.list) {
      if (this.touches(tile, site)) {
        drawSite(
          ctx,
          site.kind,
          (site.x - tile.left) * scale,
          (tile.top - site.y) * scale,
          this.sites.pitch * scale * 0.4,
        );
      }
    }
    this.tiles.set(key, tile);
    if (this.tiles.size > MOST_TILES) {
      this.tiles.delete(this.tiles.keys().next().value);
    }
    return tile;
  }

  toScreen(x, y) {
    return [
      (x - this.x) * this.scale + this.host.clientWidth / 2,
      (this.y - y) * this.scale + this.host.clientHeight / 2,
    ];
  }

  drawLabels(ctx) {
    if (this.sites.pitch * this.scale < LABEL_PITCH) {
      return;
    }
    ctx.font = '11px "DejaVu Sans", Verdana, sans-serif';
    ctx.textAlign = 'center';
    ctx.textBaseline = 'top';
    ctx.fillStyle = '#f0f3f6';
    for (const site of this.sites.list) {
      const [x, y] = this.toScreen(site.x, site.y);
      if (x > -20 && y > -20 && x < this.host.clientWidth + 20 && y < this.host.clientHeight + 20) {
        ctx.fillText(`${site.row}/${site.column}`, x, y + this.sites.pitch * this.scale * 0.36);
      }
    }
  }

  drawMarks(ctx) {
    const { path, now, found } = this.marks;
    if (path.length > 1) {
      ctx.beginPath();
      for (const [x, y] of path) {
        ctx.lineTo(...this.toScreen(x, y));
      }
      ctx.strokeStyle = '#ffe14d';
      ctx.lineWidth = 2;
      ctx.stroke();
    }
    if (found) {
      const [x, y] = this.toScreen(found.x, found.y);
      const r = Math.max(14, this.sites.pitch * this.scale * 0.6);
      ctx.strokeStyle = '#ffffff';
      ctx.lineWidth = 3;
      ctx.strokeRect(x - r, y - r, 2 * r, 2 * r);
    }
    if (now) {
      const [x, y] = this.toScreen(now.x_mm, now.y_mm);
      for (const [style, width] of [
        ['#000000', 8],
        ['#ffffff', 4],
      ]) {
        ctx.strokeStyle = style;
        ctx.lineWidth = width;
        ctx.beginPath();
        crossHair(ctx, x, y, 7, 22);
        ctx.stroke();
      }
    }
  }
}
