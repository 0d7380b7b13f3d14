// The sheet as a list of sites: where each tube stands and what is known of it.

/** In the order of drawing: what matters most is on top. */
export const KINDS = ['missing', 'open', 'plugged', 'visited', 'verified', 'contradicted'];

export class SheetSites {
  constructor(sheet) {
    this.sheet = sheet;
    this.list = [];
    this.byAddress = new Map();
    const stride = sheet.column_stride || 1;
    for (const [row, ...runs] of sheet.rows || []) {
      for (let k = 0; k + 1 < runs.length; k += 2) {
        for (let column = runs[k]; column <= runs[k + 1]; column += stride) {
          this.add(row, column, 'open');
        }
      }
    }
    for (const [row, column] of sheet.plugs || []) {
      this.add(row, column, 'plugged');
    }
    for (const [row, column] of sheet.missing || []) {
      this.add(row, column, 'missing');
    }
    const lengths = [sheet.row_step_mm, sheet.column_step_mm].map((step) => Math.hypot(...step));
    this.pitch = Math.min(...lengths) * (stride === 2 ? 1.2 : 1);
    this.bounds = this.list.reduce(
      (all, site) => ({
        left: Math.min(all.left, site.x),
        right: Math.max(all.right, site.x),
        bottom: Math.min(all.bottom, site.y),
        top: Math.max(all.top, site.y),
      }),
      { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity },
    );
  }

  add(row, column, kind) {
    const key = `${row},${column}`;
    const known = this.byAddress.get(key);
    if (known) {
      known.kind = kind;
      known.built = kind;
      return;
    }
    const [x, y] = this.place(row, column);
    const site = { row, column, x, y, kind, built: kind, count: 0, last: null };
    this.list.push(site);
    this.byAddress.set(key, site);
  }

  /** Where an address is, sheet frame, mm. */
  place(row, column) {
    const {
      origin_mm: origin = [0, 0],
      row_step_mm: down,
      column_step_mm: along,
      odd_row_shift: shift = 0,
    } = this.sheet;
    const shifted = column + (Math.abs(row) % 2 === 1 ? shift : 0);
    return [
      origin[0] + row * down[0] + shifted * along[0],
      origin[1] + row * down[1] + shifted * along[1],
    ];
  }

  find(row, column) {
    return this.byAddress.get(`${row},${column}`) || null;
  }

  /** The site nearest to (x, y) within half a pitch, or null. */
  at(x, y) {
    let best = null;
    let least = this.pitch / 2;
    for (const site of this.list) {
      const distance = Math.hypot(site.x - x, site.y - y);
      if (distance < least) {
        least = distance;
        best = site;
      }
    }
    return best;
  }

  /** Takes what was visited; returns the sites that changed. */
  update(visits) {
    const changed = [];
    for (const [row, column, kind, count, last] of visits.tubes || []) {
      const site = this.find(row, column);
      if (site && (site.kind !== kind || site.count !== count)) {
        if (site.kind !== kind) {
          changed.push(site);
        }
        Object.assign(site, { kind, count, last });
      }
    }
    return changed;
  }
}
