// Start: the operator names a tube-end in a picture that stands still; the box says what follows
// and whether it is taken.
import { ask } from './dialog.js';
import { button, labelled, make, tell, wholeNumber } from './dom.js';
import { drawChoice, drawCursor, drawWindow, plate, COLOURS } from './marks.js';
import { addressOf, threeTubes, waysToChoose } from './numbering.js';
import { nearestPlace, nextPlace, PictureView } from './picture.js';
import { WindowEditor } from './window_editor.js';

export class StartScreen {
  constructor(box, notify, go) {
    this.box = box;
    this.notify = notify;
    this.go = go;
    this.view = new PictureView({
      label:
        'Picture that stands still. Arrow keys go from tube-end to tube-end, Enter chooses it.',
    });
    this.frame = null;
    this.lattice = null;
    this.clicks = [];
    this.way = 0;
    this.cursor = null;
    this.picture = make('p', { class: 'step-words' });
    this.list = make('ol', { class: 'clicks' });
    this.numbering = make('p', { class: 'step-words' });
    this.turn = button('Turn the numbers', () => this.turnOn());
    // A turned numbering starts as well as the right one: somebody has to have looked.
    const sure = labelled('I compared a second tube-end: it is right', { type: 'checkbox' });
    sure.row.classList.add('toggle');
    this.sure = sure.input;
    this.sureRow = sure.row;
    this.sure.addEventListener('change', () => this.update());
    this.refusal = make('div', { class: 'refusal bad', role: 'alert', hidden: true });
    this.accept = button('Start tracking', () => this.send(false), { class: 'main' });
    this.anyway = button('Start all the same', () => this.sendAnyway(), {
      class: 'grave',
      hidden: true,
    });
    this.window = new WindowEditor(box, notify, this.view, () => this.view.paint());
    this.side = make(
      'section',
      { class: 'side steps', 'aria-label': 'Steps' },
      make('h2', {}, 'Start'),
      make(
        'section',
        { 'aria-label': 'Step 1' },
        make('h3', {}, '1  A picture at rest'),
        this.picture,
        button('Take a new picture', () => this.freeze()),
      ),
      make(
        'section',
        { 'aria-label': 'Step 2' },
        make('h3', {}, '2  Click a tube-end that you know'),
        this.list,
      ),
      make(
        'section',
        { 'aria-label': 'Step 3' },
        make('h3', {}, '3  Check the other numbers'),
        this.numbering,
        this.turn,
        this.sureRow,
      ),
      this.refusal,
      make(
        'div',
        { class: 'buttons' },
        this.accept,
        this.anyway,
        button('Cancel', () => this.cancel()),
      ),
      this.window.element,
    );
    this.element = make(
      'section',
      { class: 'start screen', 'aria-label': 'Start' },
      this.view.host,
      this.side,
    );
    this.view.host.addEventListener('click', (event) => this.clicked(event));
    this.view.host.addEventListener('keydown', (event) => this.pressed(event));
  }

  async shown() {
    if (!this.frame) {
      await this.freeze();
    }
  }

  /** Nobody's start is prepared on an old picture: it goes when the screen is left. */
  hidden() {
    this.forget();
    this.frame = null;
  }

  forget() {
    this.clicks = [];
    this.lattice = null;
    this.cursor = null;
    this.way = 0;
    this.sure.checked = false;
    this.refused = null;
    this.refusal.hidden = true;
    this.anyway.hidden = true;
  }

  async freeze() {
    if (!this.box.operating) {
      tell(
        this.picture,
        'Only the operator starts. Press "Operator" above to become the operator, then take a new picture.',
      );
      this.show();
      return;
    }
    this.forget();
    tell(this.picture, 'Taking the picture …');
    this.show();
    const taken = await this.box.post('/api/freeze');
    const frame = taken.good ? await this.box.picture('/api/frozen') : null;
    if (!frame) {
      tell(this.picture, `No picture: ${taken.good ? 'it did not come' : taken.words}`);
      return;
    }
    this.frame = frame;
    this.window.take(frame.sighting);
    tell(this.picture, 'This picture stands still. Looking for tube-ends …');
    this.show();
    const lattice = await this.box.get('/api/lattice');
    if (this.frame !== frame) {
      return;
    }
    this.lattice = lattice.good ? lattice.data : { found: false, words: lattice.words };
    const ways = waysToChoose(this.lattice);
    tell(
      this.picture,
      ways.length
        ? `This picture stands still. ${this.lattice.elements.length} tube-ends found: one click is enough.`
        : `This picture stands still. ${this.lattice.words || 'No lattice was found.'} Click three tube-ends that are not in one line.`,
    );
    this.show();
  }

  get ways() {
    return waysToChoose(this.lattice);
  }

  get needed() {
    return this.ways.length ? 1 : 3;
  }

  // Clicks.

  clicked(event) {
    const place = this.view.at(event);
    if (place && this.frame && !this.window.busy) {
      this.choose(place);
    }
  }

  pressed(event) {
    const places = this.ways.length ? this.lattice.elements : null;
    if (event.key.startsWith('Arrow') && this.frame) {
      event.preventDefault();
      const middle = this.cursor || { u: this.view.width / 2, v: this.view.height * 0.4 };
      if (places) {
        this.cursor = this.cursor
          ? nextPlace(places, this.cursor, event.key) || this.cursor
          : nearestPlace(places, middle);
      } else {
        const step = event.shiftKey ? 1 : 8;
        this.cursor = {
          u: Math.min(
            Math.max(
              middle.u + step * ((event.key === 'ArrowRight') - (event.key === 'ArrowLeft')),
              0,
            ),
            this.view.width - 1,
          ),
          v: Math.min(
            Math.max(
              middle.v + step * ((event.key === 'ArrowDown') - (event.key === 'ArrowUp')),
              0,
            ),
            this.view.height - 1,
          ),
        };
      }
      this.view.paint();
    } else if ((event.key === 'Enter' || event.key === ' ') && this.cursor) {
      event.preventDefault();
      this.choose(this.cursor);
    }
  }

  choose({ u, v }) {
    const element = this.ways.length ? nearestPlace(this.lattice.elements, { u, v }, 40) : null;
    if (this.ways.length && !element) {
      this.notify('No tube-end was found there: click into the dark of one.', 'bad');
      return;
    }
    const click = {
      element,
      u: element ? element.u : u,
      v: element ? element.v : v,
      row: '',
      column: '',
    };
    const near = this.clicks.findIndex((other) => Math.hypot(other.u - u, other.v - v) < 15);
    if (this.needed === 1) {
      this.clicks = [click];
    } else if (near >= 0) {
      this.clicks.splice(near, 1);
    } else {
      this.clicks =
        this.clicks.length < this.needed
          ? [...this.clicks, click]
          : [...this.clicks.slice(0, -1), click];
    }
    this.settle();
    this.show();
    const field = this.list.querySelectorAll('li');
    const last = field[field.length - 1];
    if (last) {
      last.querySelector('input').focus();
    }
  }

  /** What was refused no longer stands. */
  settle() {
    this.sure.checked = false;
    this.refused = null;
    this.refusal.hidden = true;
    this.anyway.hidden = true;
  }

  showClicks() {
    this.list.replaceChildren(
      ...this.clicks.map((click, index) => {
        const input = (name, label) => {
          const made = labelled(label, {
            inputmode: 'numeric',
            maxlength: 6,
            value: click[name],
            autocomplete: 'off',
            'aria-label': `${label} of tube-end ${index + 1}`,
          });
          made.input.addEventListener('input', () => {
            click[name] = made.input.value;
            this.settle();
            this.update();
          });
          made.input.addEventListener('keydown', (event) => {
            if (event.key === 'Enter' && !this.accept.disabled) {
              this.accept.focus();
            }
          });
          return made.row;
        };
        return make(
          'li',
          { class: this.refused && this.refused.click === index ? 'blamed' : null },
          input('row', 'Row'),
          input('column', 'Column'),
        );
      }),
    );
    if (!this.clicks.length) {
      this.list.replaceChildren(
        make(
          'li',
          { class: 'none' },
          this.needed === 1 ? 'None yet: click into its dark.' : 'None yet: click three.',
        ),
      );
    }
  }

  // Numbers.

  addressOfClick(click) {
    const row = wholeNumber(click.row);
    const column = wholeNumber(click.column);
    return row === null || column === null ? null : { row, column };
  }

  turnOn() {
    this.way = (this.way + 1) % this.ways.length;
    this.sure.checked = false;
    this.settle();
    this.update();
  }

  show() {
    this.showClicks();
    this.update();
  }

  update() {
    const complete =
      this.clicks.length === this.needed &&
      this.clicks.every((click) => this.addressOfClick(click));
    const ways = this.ways.length;
    this.turn.hidden = ways < 2;
    this.sureRow.hidden = ways < 2 || !complete;
    tell(
      this.numbering,
      !complete
        ? 'They appear when the tube-end has its address.'
        : ways === 0
          ? 'The box checks that the three fit together.'
          : ways === 1
            ? 'The box knows which way they run. Compare one that you know.'
            : `Way ${this.way + 1} of ${ways}: turn until they are right. Compare one that you know.`,
    );
    this.accept.disabled = !complete || !this.frame || (ways > 1 && !this.sure.checked);
    this.view.show(this.frame && this.frame.bitmap, (ctx, view) => this.draw(ctx, view));
    this.view.setOld(this.frame ? null : Infinity);
  }

  draw(ctx, view) {
    drawWindow(ctx, view, this.window.window, this.window.optimum);
    const anchor = this.clicks[0];
    const address = anchor && this.addressOfClick(anchor);
    for (const element of (this.lattice && this.lattice.elements) || []) {
      const [x, y] = view.toScreen(element.u, element.v);
      ctx.beginPath();
      ctx.arc(x, y, Math.max(6, (element.size_px || 20) * 0.25 * view.scale), 0, 2 * Math.PI);
      ctx.lineWidth = 2;
      ctx.strokeStyle = COLOURS.good;
      ctx.stroke();
      if (address && anchor.element && element !== anchor.element) {
        const its = addressOf(element, anchor.element, address, this.ways[this.way]);
        plate(ctx, `${its.row}/${its.column}`, x, y, { size: 12, view });
      }
    }
    this.clicks.forEach((click, index) => {
      const its = this.addressOfClick(click);
      const bad = Boolean(this.refused) && this.refused.click === index;
      drawChoice(
        ctx,
        view,
        click,
        its ? `${its.row} / ${its.column}` : `tube-end ${index + 1}`,
        bad,
      );
    });
    if (this.cursor && document.activeElement === view.host) {
      drawCursor(ctx, view, this.cursor);
    }
    this.window.draw(ctx, view);
  }

  // The start itself.

  tubes() {
    const anchor = this.clicks[0];
    const three = anchor.element ? threeTubes(this.lattice.elements, anchor.element) : null;
    if (three) {
      const way = this.ways[this.way];
      return three.map((element) => ({
        u: element.u,
        v: element.v,
        ...addressOf(element, anchor.element, this.addressOfClick(anchor), way),
      }));
    }
    return this.clicks.map((click) => ({ u: click.u, v: click.v, ...this.addressOfClick(click) }));
  }

  async send(confirmed) {
    const agreed = !confirmed && this.box.judgement().standing !== 'unknown';
    if (agreed && !(await this.mayReplace())) {
      return;
    }
    this.accept.disabled = true;
    const start = { field: this.frame.sighting.field, tubes: this.tubes(), confirmed };
    let answer = await this.box.post('/api/start', start);
    // Warnings of what was just agreed to, or compared.
    const known = { tracking: agreed, numbering: !this.sureRow.hidden && this.sure.checked };
    while (answer.data.confirmable && known[answer.data.refusal]) {
      known[answer.data.refusal] = false;
      answer = await this.box.post('/api/start', { ...start, confirmed: true });
    }
    if (answer.good && answer.data.taken) {
      this.notify('The start is taken: the box tracks.');
      this.go('live');
      return;
    }
    // Behind the first, tube-ends follow from the lattice: the blame is the first one's.
    const click = answer.data.click;
    this.refused = {
      click: Number.isInteger(click) ? Math.min(click, this.clicks.length - 1) : null,
    };
    this.refusal.replaceChildren(
      make('h3', {}, 'The start was refused'),
      make('p', {}, answer.data.words || answer.words),
    );
    this.refusal.hidden = false;
    this.anyway.hidden = !answer.data.confirmable;
    this.show();
    this.refusal.scrollIntoView({ block: 'nearest' });
  }

  /** A track that stands is never replaced without a word. */
  async mayReplace() {
    const now = this.box.judgement();
    const where = now.row === undefined ? '' : ` at ${now.row} / ${now.column}`;
    return Boolean(
      await ask({
        title: 'The box is tracking',
        grave: true,
        accept: 'Replace the track',
        cancel: 'Keep the track',
        text: `It tracks${where}. A new start replaces that: what it knows now is given up.`,
      }),
    );
  }

  async sendAnyway() {
    if (
      await ask({
        title: 'Start all the same?',
        grave: true,
        accept: 'I have checked: start',
        cancel: 'No',
        text: `${this.refusal.lastChild.textContent} If the address is wrong, every tube named from now on is wrong.`,
      })
    ) {
      await this.send(true);
    }
  }

  cancel() {
    this.go('live');
  }
}
