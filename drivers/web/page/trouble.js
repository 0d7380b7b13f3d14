// Trouble-shooting: what the box expects and measures, the contrast, the lamp, counters,
// recordings.
import { button, labelled, make, tell } from './dom.js';
import { drawEstimates, drawResiduals, drawSighting } from './marks.js';
import { PictureView } from './picture.js';

const MAGNIFIED = 20;
const HISTOGRAM_MS = 500;

/** {a: {b: 1}} as [['a b', 1]]. */
export function flattened(object, prefix = '') {
  return Object.entries(object || {}).flatMap(([key, value]) => {
    const name = `${prefix}${key.replace(/_/g, ' ')}`;
    return value !== null && typeof value === 'object' && !Array.isArray(value)
      ? flattened(value, `${name} `)
      : [[name, value]];
  });
}

function sizeWords(bytes) {
  return bytes > 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.ceil(bytes / 1000)} kB`;
}

export class TroubleScreen {
  constructor(box, notify) {
    this.box = box;
    this.notify = notify;
    this.view = new PictureView({ label: 'Camera picture with estimates and residuals' });
    const toggle = (text, checked) => {
      const made = labelled(text, { type: 'checkbox', checked });
      made.row.classList.add('toggle');
      made.input.addEventListener('change', () => this.view.paint());
      return made;
    };
    this.estimates = toggle('Estimates of all tubes', true);
    this.residuals = toggle(`Residuals, ${MAGNIFIED} times`, true);
    this.histogram = make('canvas', {
      class: 'histogram',
      role: 'img',
      'aria-label': 'Contrast: how often each grey level stands in the window',
    });
    this.histogramWords = make('p', { class: 'step-words' });
    this.histogramAt = 0;
    const lamp = labelled('Lamp', { type: 'range', min: 0, max: 1000, step: 10, value: 0 });
    this.lamp = lamp.input;
    // Until it is known where it stands: a key would begin at 0.
    this.lamp.disabled = true;
    this.lampWords = make('output', { class: 'step-words', for: this.lamp.id });
    this.lamp.addEventListener('input', () => tell(this.lampWords, `${this.lamp.value / 10} %`));
    this.lamp.addEventListener('change', () => this.setLamp({ permille: Number(this.lamp.value) }));
    this.levels = make('dl', { class: 'facts' });
    this.counters = make('tbody', {});
    this.recordings = make('ul', { class: 'recordings' });
    this.side = make(
      'section',
      { class: 'side', 'aria-label': 'Levels, counters and recordings', tabindex: '0' },
      make('h2', {}, 'Trouble-shooting'),
      this.estimates.row,
      this.residuals.row,
      make('h3', {}, 'Contrast in the window'),
      this.histogram,
      this.histogramWords,
      this.levels,
      make('h3', {}, 'Lamp'),
      lamp.row,
      this.lampWords,
      make(
        'div',
        { class: 'buttons' },
        button('Automatic', () => this.setLamp({ automatic: true })),
      ),
      make('h3', {}, 'Recordings'),
      make(
        'div',
        { class: 'buttons' },
        button('Record now', () => this.record()),
      ),
      this.recordings,
      make('h3', {}, 'Counters'),
      make('table', { class: 'counters', 'aria-label': 'Counters' }, this.counters),
    );
    this.element = make(
      'section',
      { class: 'trouble screen', 'aria-label': 'Trouble-shooting' },
      this.view.host,
      this.side,
    );
  }

  async shown() {
    this.status(this.box.status);
    await this.list();
  }

  camera({ bitmap, sighting }) {
    this.standing = this.box.judgement().standing;
    this.view.show(bitmap, (ctx, view) => this.draw(ctx, view));
    this.tick();
    if (performance.now() - this.histogramAt > HISTOGRAM_MS) {
      this.histogramAt = performance.now();
      this.drawHistogram(bitmap, sighting.window);
    }
    const { thresholds, lamp } = sighting;
    const values = [
      ['Edge threshold', thresholds && thresholds.edge],
      ['Region threshold', thresholds && thresholds.region],
      ['Gain', sighting.camera && sighting.camera.gain],
      ['Offset', sighting.camera && sighting.camera.offset],
    ];
    this.levels.replaceChildren(
      ...values.map(([name, value]) =>
        make(
          'div',
          {},
          make('dt', {}, name),
          make('dd', {}, value === undefined || value === null ? 'not reported' : String(value)),
        ),
      ),
    );
    if (lamp) {
      this.lamp.disabled = false;
      if (document.activeElement !== this.lamp) {
        this.lamp.value = String(lamp.permille);
      }
      tell(
        this.lampWords,
        `${lamp.permille / 10} %, ${lamp.automatic ? 'automatic' : 'by hand'}${lamp.words ? `: ${lamp.words}` : ''}`,
      );
    }
  }

  tick() {
    const { standing } = this.box.judgement();
    const age = this.box.pictureAge();
    this.view.setOld(this.box.link !== 'up' || !(age <= 0.5) ? age : null);
    this.standing = standing;
  }

  draw(ctx, view) {
    const { sighting } = this.box.last;
    const known = this.standing !== 'unknown';
    drawSighting(
      ctx,
      view,
      { window: sighting.window, optimum: sighting.optimum, tubes: sighting.tubes },
      known ? 'none' : 'unknown',
    );
    if (known && this.estimates.input.checked) {
      drawEstimates(ctx, view, sighting.estimates || []);
    }
    if (known && this.residuals.input.checked) {
      drawResiduals(ctx, view, sighting.tubes || [], sighting.estimates || [], MAGNIFIED);
    }
  }

  drawHistogram(bitmap, window) {
    const area = window || { left: 0, top: 0, width: bitmap.width, height: bitmap.height };
    const small = document.createElement('canvas');
    small.width = 200;
    small.height = 120;
    const from = small.getContext('2d', { willReadFrequently: true });
    from.imageSmoothingEnabled = false;
    from.drawImage(
      bitmap,
      area.left,
      area.top,
      area.width,
      area.height,
      0,
      0,
      small.width,
      small.height,
    );
    const pixels = from.getImageData(0, 0, small.width, small.height).data;
    const bins = new Array(64).fill(0);
    for (let k = 0; k < pixels.length; k += 4) {
      bins[pixels[k] >> 2] += 1;
    }
    const ratio = globalThis.devicePixelRatio || 1;
    const width = this.histogram.clientWidth;
    const height = this.histogram.clientHeight;
    this.histogram.width = width * ratio;
    this.histogram.height = height * ratio;
    const ctx = this.histogram.getContext('2d');
    ctx.scale(ratio, ratio);
    const most = Math.max(...bins);
    ctx.fillStyle = '#b3bcc6';
    bins.forEach((count, index) => {
      const tall = (count / most) * (height - 2);
      ctx.fillRect((index * width) / 64, height - tall, width / 64 - 1, tall);
    });
    const all = small.width * small.height;
    const share = (low, high) => bins.slice(low, high).reduce((sum, count) => sum + count, 0) / all;
    tell(
      this.histogramWords,
      `Dark (below 64): ${(100 * share(0, 16)).toFixed(0)} %. Washed out (above 251): ${(100 * share(63, 64)).toFixed(0)} %.`,
    );
  }

  status(status) {
    if (status && !this.element.hidden) {
      this.counters.replaceChildren(
        ...flattened(status).map(([name, value]) =>
          make(
            'tr',
            {},
            make('th', { scope: 'row' }, name),
            make('td', {}, Array.isArray(value) ? value.join(', ') : String(value)),
          ),
        ),
      );
    }
  }

  async setLamp(command) {
    const answer = await this.box.post('/api/lamp', command);
    if (!answer.good) {
      this.notify(answer.words, 'bad');
    }
  }

  async record() {
    const answer = await this.box.post('/api/record');
    this.notify(
      answer.good ? `Recorded: ${answer.data.path}` : answer.words,
      answer.good ? '' : 'bad',
    );
    await this.list();
  }

  async list() {
    const answer = await this.box.get('/api/recordings');
    const items = answer.good && Array.isArray(answer.data) ? answer.data : [];
    this.recordings.replaceChildren(
      ...items.map((item) =>
        make(
          'li',
          {},
          make(
            'a',
            { href: `/api/recordings/${encodeURIComponent(item.name)}`, download: item.name },
            item.name,
          ),
          ` ${sizeWords(item.bytes)}${item.reason ? `, ${item.reason}` : ''}`,
        ),
      ),
    );
    if (!items.length) {
      this.recordings.replaceChildren(
        make('li', {}, answer.good ? 'The recorder holds none.' : answer.words),
      );
    }
  }
}
