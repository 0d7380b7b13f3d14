// Sheet: all of it as a map, with what was visited, verified and contradicted, and where the tool
// is.
import { button, labelled, make, save, tell, wholeNumber } from './dom.js';
import { sheetCsv, sheetPng, sheetSvg } from './sheet_export.js';
import { SheetMap } from './sheet_map.js';
import { KINDS, SheetSites } from './sheet_sites.js';
import { drawSite } from './sheet_symbols.js';

const REFRESH_MS = 2000;
const MOST_PATH = 2000;

export class SheetScreen {
  constructor(box, notify) {
    this.box = box;
    this.notify = notify;
    this.map = new SheetMap(
      'Map of the tubesheet. Arrow keys move it, plus and minus zoom, 0 shows all.',
    );
    this.map.host.addEventListener('site', (event) => this.tellSite(event.detail));
    this.sites = null;
    this.title = make('h2', {}, 'Sheet');
    this.words = make('p', { class: 'step-words', role: 'status' }, 'Click a tube, or search one.');
    this.counts = new Map();
    const row = labelled('Row', { inputmode: 'numeric', maxlength: 6 });
    const column = labelled('Column', { inputmode: 'numeric', maxlength: 6 });
    this.search = make(
      'form',
      {
        class: 'search',
        'aria-label': 'Search an address',
        onsubmit: (event) => {
          event.preventDefault();
          this.find(wholeNumber(row.input.value), wholeNumber(column.input.value));
        },
      },
      row.row,
      column.row,
      make('button', { type: 'submit', class: 'main' }, 'Find'),
    );
    this.legend = make(
      'ul',
      { class: 'legend', 'aria-label': 'Legend' },
      [...KINDS].reverse().map((kind) => this.legendRow(kind)),
    );
    this.side = make(
      'section',
      { class: 'side', 'aria-label': 'Search, legend and export' },
      this.title,
      this.search,
      this.words,
      make(
        'div',
        { class: 'buttons zoom' },
        button('+', () => this.map.zoom(1.6), { 'aria-label': 'Zoom in' }),
        button('−', () => this.map.zoom(1 / 1.6), { 'aria-label': 'Zoom out' }),
        button('All', () => this.map.all()),
        button('Tool', () => this.toTool()),
      ),
      this.legend,
      make('h3', {}, 'Export'),
      make(
        'div',
        { class: 'buttons' },
        ['SVG', 'PNG', 'CSV'].map((kind) => button(kind, () => this.export(kind))),
      ),
    );
    this.element = make(
      'section',
      { class: 'sheet screen', 'aria-label': 'Sheet' },
      this.map.host,
      this.side,
    );
  }

  legendRow(kind) {
    const canvas = make('canvas', { width: 28, height: 28, 'aria-hidden': 'true' });
    drawSite(canvas.getContext('2d'), kind, 14, 14, 12);
    const count = make('span', { class: 'count' }, '–');
    this.counts.set(kind, count);
    return make('li', {}, canvas, make('span', {}, kind), count);
  }

  async shown() {
    await this.refresh();
    this.timer = setInterval(() => this.refresh(), REFRESH_MS);
  }

  hidden() {
    clearInterval(this.timer);
  }

  async refresh() {
    if (!this.sites) {
      const answer = await this.box.get('/api/sheet');
      if (!answer.good) {
        tell(this.words, answer.words);
        return;
      }
      this.sites = new SheetSites(answer.data);
      tell(this.title, answer.data.name || 'Sheet');
      this.map.setSites(this.sites);
    }
    const visits = await this.box.get('/api/visits');
    if (!visits.good) {
      return;
    }
    const path = visits.data.path || [];
    const step = Math.ceil(path.length / MOST_PATH) || 1;
    this.map.marks.path = path.filter(
      (_, index) => index % step === 0 || index === path.length - 1,
    );
    // Where the tool is now is shown only while that is known.
    this.map.marks.now =
      this.box.judgement().standing === 'unknown' ? null : visits.data.now || null;
    this.map.changed(this.sites.update(visits.data));
    for (const [kind, count] of this.counts) {
      tell(count, String(this.sites.list.filter((site) => site.kind === kind).length));
    }
  }

  find(row, column) {
    if (row === null || column === null || !this.sites) {
      tell(this.words, 'Type a row and a column, both whole numbers.');
      return;
    }
    const site = this.sites.find(row, column);
    if (site) {
      this.map.goTo(site);
      this.tellSite(site);
    } else {
      tell(this.words, `There is no tube ${row} / ${column} on this sheet.`);
    }
  }

  tellSite(site) {
    tell(
      this.words,
      !site
        ? 'No tube stands there.'
        : `Row ${site.row}, column ${site.column}: ${site.kind}${site.count ? `, ${site.count} time${site.count === 1 ? '' : 's'}` : ''}.`,
    );
  }

  toTool() {
    const { now } = this.map.marks;
    if (now) {
      this.map.x = now.x_mm;
      this.map.y = now.y_mm;
      this.map.scale = Math.max(this.map.scale, 50 / this.sites.pitch);
      this.map.ask();
    } else {
      tell(this.words, 'Where the tool is, is not known.');
    }
  }

  async export(kind) {
    if (!this.sites) {
      return;
    }
    const { marks } = this.map;
    if (kind === 'CSV') {
      save('sheet.csv', 'text/csv', sheetCsv(this.sites));
    } else if (kind === 'SVG') {
      save('sheet.svg', 'image/svg+xml', sheetSvg(this.sites, marks));
    } else {
      save('sheet.png', 'image/png', await sheetPng(this.sites, marks));
    }
    this.notify(`The sheet is saved as ${kind}.`);
  }
}
