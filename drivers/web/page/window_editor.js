// The search window and the optimum point: dragged on the picture, or typed.
import { button, labelled, make, wholeNumber } from './dom.js';

const GRIP = 14;
const LEAST_PX = 40;

export class WindowEditor {
  constructor(box, notify, view, changed) {
    this.box = box;
    this.notify = notify;
    this.view = view;
    this.changed = changed;
    this.window = null;
    this.optimum = null;
    this.held = null;
    this.busy = false;
    // One of the numbers of `window` or `optimum`, which are replaced as a whole.
    const field = (label, holder, key) => {
      const made = labelled(label, { inputmode: 'numeric', maxlength: 5 });
      made.input.addEventListener('change', () => {
        const value = wholeNumber(made.input.value);
        if (value !== null && this.window) {
          this[holder][key] = value;
          this.bound();
        }
        this.refresh();
      });
      this.fields.push([made.input, () => this[holder][key]]);
      return made.row;
    };
    this.fields = [];
    this.element = make(
      'details',
      { class: 'window-editor', ontoggle: () => this.toggled() },
      make('summary', {}, 'Search window and optimum'),
      make(
        'p',
        { class: 'step-words' },
        'Drag the corners, the frame or the diamond, or type pixels.',
      ),
      make(
        'div',
        { class: 'grid' },
        field('Left', 'window', 'left'),
        field('Top', 'window', 'top'),
        field('Width', 'window', 'width'),
        field('Height', 'window', 'height'),
        field('Optimum u', 'optimum', 'u'),
        field('Optimum v', 'optimum', 'v'),
      ),
      button('Apply', () => this.apply()),
    );
    view.host.addEventListener('pointerdown', (event) => this.grab(event));
    view.host.addEventListener('pointermove', (event) => this.drag(event));
    view.host.addEventListener('pointerup', () => this.drop());
    view.host.addEventListener('pointercancel', () => this.drop());
  }

  take({ window, optimum }) {
    this.window = window ? { ...window } : null;
    this.optimum = optimum
      ? { ...optimum }
      : window
        ? { u: window.left + window.width / 2, v: window.top + window.height / 2 }
        : null;
    this.refresh();
  }

  toggled() {
    this.busy = this.element.open && Boolean(this.window);
    this.changed();
  }

  refresh() {
    for (const [input, get] of this.fields) {
      input.value = this.window && this.optimum ? String(Math.round(get())) : '';
    }
    this.changed();
  }

  /** Keeps the window on the frame and the optimum in the window. */
  bound() {
    const { window, optimum, view } = this;
    const within = (value, low, high) => Math.min(Math.max(Math.round(value), low), high);
    window.left = within(window.left, 0, view.width - LEAST_PX);
    window.top = within(window.top, 0, view.height - LEAST_PX);
    window.width = within(window.width, LEAST_PX, view.width - window.left);
    window.height = within(window.height, LEAST_PX, view.height - window.top);
    optimum.u = within(optimum.u, window.left, window.left + window.width - 1);
    optimum.v = within(optimum.v, window.top, window.top + window.height - 1);
  }

  grips() {
    const { left, top, width, height } = this.window;
    return [
      ['optimum', this.optimum.u, this.optimum.v],
      ['left top', left, top],
      ['right top', left + width, top],
      ['left bottom', left, top + height],
      ['right bottom', left + width, top + height],
      ['left', left, top + height / 2],
      ['right', left + width, top + height / 2],
      ['top', left + width / 2, top],
      ['bottom', left + width / 2, top + height],
    ];
  }

  grab(event) {
    if (!this.busy) {
      return;
    }
    const box = this.view.host.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const found = this.grips().find(([, u, v]) => {
      const [gx, gy] = this.view.toScreen(u, v);
      return Math.hypot(gx - x, gy - y) < 2 * GRIP;
    });
    if (found) {
      [this.held] = found;
      this.view.host.setPointerCapture(event.pointerId);
      event.preventDefault();
    }
  }

  drag(event) {
    if (!this.held) {
      return;
    }
    const box = this.view.host.getBoundingClientRect();
    const { u, v } = this.view.toFrame(event.clientX - box.left, event.clientY - box.top);
    const right = this.window.left + this.window.width;
    const bottom = this.window.top + this.window.height;
    if (this.held === 'optimum') {
      this.optimum = { u, v };
    }
    if (this.held.includes('left')) {
      this.window.left = Math.min(u, right - LEAST_PX);
      this.window.width = right - this.window.left;
    } else if (this.held.includes('right')) {
      this.window.width = u - this.window.left;
    }
    if (this.held.includes('top')) {
      this.window.top = Math.min(v, bottom - LEAST_PX);
      this.window.height = bottom - this.window.top;
    } else if (this.held.includes('bottom')) {
      this.window.height = v - this.window.top;
    }
    this.bound();
    this.refresh();
  }

  drop() {
    this.held = null;
  }

  draw(ctx, view) {
    if (!this.busy) {
      return;
    }
    for (const [, u, v] of this.grips()) {
      const [x, y] = view.toScreen(u, v);
      ctx.fillStyle = '#ffffff';
      ctx.strokeStyle = '#000000';
      ctx.lineWidth = 2;
      ctx.fillRect(x - GRIP / 2, y - GRIP / 2, GRIP, GRIP);
      ctx.strokeRect(x - GRIP / 2, y - GRIP / 2, GRIP, GRIP);
    }
  }

  async apply() {
    if (!this.window) {
      return;
    }
    const window = await this.box.post('/api/window', this.window);
    const optimum = window.good ? await this.box.post('/api/optimum', this.optimum) : window;
    this.notify(
      !optimum.good
        ? optimum.words
        : optimum.data.when === 'restart'
          ? "Kept. The window and the optimum hold from the box's next start on."
          : 'The window and the optimum hold now.',
      optimum.good ? '' : 'bad',
    );
  }
}
