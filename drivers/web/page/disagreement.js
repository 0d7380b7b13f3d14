// Disagreement: what the robot claimed and what the box saw, side by side, with the picture at
// that instant.
import { button, labelled, make, tell } from './dom.js';
import { drawSighting } from './marks.js';
import { PictureView } from './picture.js';

const address = (tube) =>
  tube && Number.isInteger(tube.row) ? `${tube.row} / ${tube.column}` : 'not known';

export class DisagreementScreen {
  constructor(box, notify, changed) {
    this.box = box;
    this.notify = notify;
    this.changed = changed;
    this.items = [];
    this.chosen = null;
    this.frame = null;
    this.asked = 0;
    this.view = new PictureView({ label: 'The picture at that instant' });
    this.list = make('ul', { class: 'disagreements', 'aria-label': 'Disagreements' });
    this.robot = make('p', { class: 'big-address' });
    this.seen = make('p', { class: 'big-address' });
    this.words = make('p', { class: 'words' });
    const step = labelled('Picture', { type: 'range', min: 0, max: 0, value: 0 });
    this.step = step.input;
    this.step.addEventListener('input', () => this.load());
    this.stepWords = make('output', { class: 'step-words', for: this.step.id });
    const name = labelled('Your name', { required: true, maxlength: 80, autocomplete: 'name' });
    const reason = labelled('Reason', { required: true, maxlength: 300 });
    this.name = name.input;
    this.reason = reason.input;
    this.form = make(
      'form',
      {
        class: 'acknowledge',
        'aria-label': 'Acknowledge',
        onsubmit: (event) => this.acknowledge(event),
      },
      name.row,
      reason.row,
      make('button', { type: 'submit', class: 'main' }, 'Acknowledge'),
    );
    this.done = make('p', { class: 'words' });
    this.detail = make(
      'div',
      { class: 'detail' },
      make(
        'div',
        { class: 'sides' },
        make(
          'section',
          { class: 'claim-side', 'aria-label': 'The robot claims' },
          make('h2', {}, 'The robot says'),
          this.robot,
        ),
        make(
          'section',
          { class: 'seen-side', 'aria-label': 'The box saw' },
          make('h2', {}, 'The box saw'),
          this.seen,
        ),
      ),
      this.view.host,
      make(
        'div',
        { class: 'stepper' },
        button('◀', () => this.move(-1), { 'aria-label': 'Earlier picture' }),
        step.row,
        button('▶', () => this.move(1), { 'aria-label': 'Later picture' }),
        this.stepWords,
      ),
    );
    this.empty = make('p', { class: 'plain' }, 'The robot and the box have not disagreed.');
    this.side = make(
      'section',
      { class: 'side', 'aria-label': 'Which disagreement' },
      make('h2', {}, 'Disagreements'),
      this.empty,
      this.list,
      this.words,
      this.form,
      this.done,
    );
    this.element = make(
      'section',
      { class: 'disagreement screen', 'aria-label': 'Disagreement' },
      this.detail,
      this.side,
    );
    this.show();
  }

  get open() {
    return this.items.filter((item) => !item.acknowledged);
  }

  /** Asks the box for the list; whoever shows how many are open calls it too. */
  async refresh() {
    const answer = await this.box.get('/api/disagreements');
    if (answer.good && Array.isArray(answer.data)) {
      this.items = answer.data;
      if (!this.items.some((item) => item.id === this.chosen)) {
        const first = this.open[0] || this.items[0];
        this.choose(first ? first.id : null);
      }
      this.show();
    }
    return this.open.length;
  }

  async shown() {
    await this.refresh();
    const open = this.open[0];
    if (open && (!this.item || this.item.acknowledged)) {
      this.choose(open.id);
    }
    this.load();
  }

  get item() {
    return this.items.find((item) => item.id === this.chosen);
  }

  choose(id) {
    this.chosen = id;
    const item = this.item;
    this.step.max = String(item ? Math.max(0, item.steps - 1) : 0);
    this.step.value = this.step.max;
    this.frame = null;
    this.show();
    this.load();
  }

  move(by) {
    this.step.value = String(Number(this.step.value) + by);
    this.load();
  }

  async load() {
    const item = this.item;
    if (!item || !this.element.isConnected || this.element.hidden) {
      return;
    }
    if (item.steps === 0) {
      this.frame = null;
      tell(this.stepWords, 'No picture was kept.');
      this.draw();
      return;
    }
    this.asked += 1;
    const mine = this.asked;
    const step = Number(this.step.value);
    const frame = await this.box.picture(
      `/api/disagreements/${encodeURIComponent(item.id)}/frame?step=${step}`,
    );
    if (mine !== this.asked) {
      return;
    }
    this.frame = frame;
    const before =
      frame && typeof frame.sighting.time_s === 'number' && typeof item.at_s === 'number'
        ? item.at_s - frame.sighting.time_s
        : null;
    tell(
      this.stepWords,
      !frame
        ? 'No picture was kept.'
        : before === null
          ? `${step + 1} of ${item.steps}`
          : before < 0.02
            ? 'at the claim'
            : `${before.toFixed(2)} s before`,
    );
    this.draw();
  }

  draw() {
    const frame = this.frame;
    this.view.setOld(frame ? null : Infinity);
    this.view.show(
      frame && frame.bitmap,
      frame &&
        ((ctx, view) => {
          const { sighting } = frame;
          const named = sighting.tool && Number.isInteger(sighting.tool.row);
          const standing =
            sighting.state !== 'tracking' && sighting.state !== 'degraded'
              ? 'unknown'
              : !named
                ? 'none'
                : sighting.aligned
                  ? 'vouched'
                  : 'seen';
          drawSighting(ctx, view, sighting, standing);
        }),
    );
  }

  show() {
    const item = this.item;
    this.detail.hidden = !item;
    this.form.hidden = !item || Boolean(item.acknowledged);
    this.empty.hidden = Boolean(item);
    this.list.replaceChildren(
      ...this.items.map((each) =>
        make(
          'li',
          {},
          button(
            `${each.acknowledged ? '✓' : '●'} ${each.wall || ''}  robot ${address(each.claim)}, box ${address(each.tube)}`,
            () => this.choose(each.id),
            {
              'aria-current': each.id === this.chosen ? 'true' : null,
              class: each.acknowledged ? 'done' : 'open',
            },
          ),
        ),
      ),
    );
    tell(this.robot, item ? address(item.claim) : '');
    tell(this.seen, item ? address(item.tube) : '');
    tell(this.words, item ? item.words || '' : '');
    tell(
      this.done,
      item && item.acknowledged
        ? `Acknowledged by ${item.acknowledged.name}: ${item.acknowledged.reason}`
        : '',
    );
  }

  async acknowledge(event) {
    event.preventDefault();
    const [name, reason] = [this.name.value.trim(), this.reason.value.trim()];
    if (!name || !reason || !this.item) {
      this.notify('Give your name and the reason.', 'bad');
      return;
    }
    const answer = await this.box.post('/api/acknowledge', { id: this.item.id, name, reason });
    this.notify(answer.good ? 'Acknowledged.' : answer.words, answer.good ? '' : 'bad');
    if (answer.good) {
      this.reason.value = '';
      await this.changed();
    }
  }
}
