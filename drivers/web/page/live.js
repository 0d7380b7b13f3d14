// Live: the picture, the tube above the guidetube, what is the matter and what to do. A click
// names a tube.
import { digits, make, tell } from './dom.js';
import { ageWords, OLD_S } from './freshness.js';
import { drawChoice, drawCursor, drawSighting } from './marks.js';
import { nearestPlace, nextPlace, PictureView } from './picture.js';
import { TubePanel } from './tube_panel.js';

const PICK_SHOWN_MS = 6000;

export class LiveScreen {
  constructor(box, notify) {
    this.box = box;
    this.notify = notify;
    this.view = new PictureView({
      label: 'Camera picture. Arrow keys go from tube to tube, Enter names it.',
    });
    this.panel = new TubePanel();
    this.pick = null;
    this.cursor = null;
    this.state = make('p', { class: 'state' });
    this.words = make('p', { class: 'words' });
    this.advice = make('p', { class: 'advice' });
    this.message = make(
      'section',
      { class: 'message', 'aria-label': 'State', 'aria-live': 'polite' },
      this.state,
      make('div', {}, this.words, this.advice),
    );
    this.facts = Object.fromEntries(
      ['Age', 'Tube-ends', 'Margin', 'Residual', 'Height', 'Lamp'].map((name) => [
        name,
        make('dd', {}, '–'),
      ]),
    );
    this.element = make(
      'section',
      { class: 'live screen', 'aria-label': 'Live' },
      this.view.host,
      make(
        'section',
        { class: 'side', 'aria-label': 'Tube above the guidetube' },
        this.panel.element,
        make(
          'dl',
          { class: 'facts' },
          Object.entries(this.facts).map(([name, value]) =>
            make('div', {}, make('dt', {}, name), value),
          ),
        ),
      ),
      this.message,
    );
    this.view.host.addEventListener('click', (event) => this.clicked(event));
    this.view.host.addEventListener('keydown', (event) => this.pressed(event));
  }

  /** A picture came. */
  camera({ bitmap }) {
    this.judgement = this.box.judgement();
    this.view.show(bitmap, (ctx, view) => this.draw(ctx, view));
    this.panel.alive();
    this.tick();
  }

  /** Ten times a second, whether or not anything comes. */
  tick() {
    const age = this.box.pictureAge();
    const judgement = this.box.judgement();
    const sighting = this.box.last ? this.box.last.sighting : null;
    const dead = this.box.link !== 'up' || !(age <= OLD_S);
    if (!this.judgement || this.judgement.standing !== judgement.standing) {
      this.judgement = judgement;
      this.view.paint();
    }
    this.view.setOld(dead ? age : null);
    this.panel.show(judgement, sighting);
    this.message.dataset.standing = judgement.standing;
    const state = dead || !sighting ? 'not known' : sighting.state;
    tell(this.state, state.toUpperCase());
    this.state.dataset.state = state;
    // The age is shown beside the picture: here it would be read aloud ten times a second.
    tell(this.words, judgement.words.replace(/: [\d.]+ (s|min)$|: no picture$/, ''));
    tell(this.advice, judgement.advice);
    this.showFacts(dead ? null : sighting, age);
    if (this.pick && performance.now() > this.pick.until) {
      this.pick = null;
      this.view.paint();
    }
  }

  showFacts(sighting, age) {
    const known = sighting || {};
    tell(
      this.facts.Age,
      ageWords(age).replace(/^(\d\.\d) s$/, (all, number) =>
        Number(number) < 0.3 ? 'under 0.3 s' : all,
      ),
    );
    tell(this.facts['Tube-ends'], digits(known.tracked, 0));
    tell(this.facts.Margin, digits(known.margin_sigma, 0, ' σ'));
    tell(this.facts.Residual, digits(known.residual_px, 2, ' px'));
    tell(this.facts.Height, digits(known.height_mm, 1, ' mm'));
    tell(this.facts.Lamp, known.lamp ? digits(known.lamp.permille / 10, 0, ' %') : '–');
  }

  draw(ctx, view) {
    const last = this.box.last;
    if (!last) {
      return;
    }
    drawSighting(ctx, view, last.sighting, this.judgement.standing);
    if (this.cursor && document.activeElement === view.host) {
      drawCursor(ctx, view, this.cursor);
    }
    if (this.pick) {
      drawChoice(ctx, view, this.pick, this.pick.text, this.pick.bad);
    }
  }

  // Naming a tube.

  places() {
    const sighting = this.box.last && this.box.last.sighting;
    const tubes = sighting ? sighting.tubes || [] : [];
    const measured = tubes.map(([, , u, v]) => ({ u, v }));
    return measured.length ? measured : [{ u: this.view.width / 2, v: this.view.height / 2 }];
  }

  clicked(event) {
    const place = this.view.at(event);
    if (place) {
      this.cursor = null;
      this.name(place);
    }
  }

  pressed(event) {
    if (event.key.startsWith('Arrow')) {
      event.preventDefault();
      const places = this.places();
      const middle = { u: this.view.width / 2, v: this.view.height * 0.4 };
      const from = this.cursor && nearestPlace(places, this.cursor, 60);
      this.cursor = from
        ? nextPlace(places, from, event.key) || from
        : nearestPlace(places, middle);
      this.view.paint();
    } else if ((event.key === 'Enter' || event.key === ' ') && this.cursor) {
      event.preventDefault();
      this.name(this.cursor);
    }
  }

  async name({ u, v }) {
    const last = this.box.last;
    if (!last || this.judgement.standing === 'unknown') {
      this.notify('No tube is named while the box does not know where it is.', 'bad');
      return;
    }
    const answer = await this.box.post('/api/pick', { field: last.sighting.field, u, v });
    const named = answer.good && Number.isInteger(answer.data.row);
    const why = answer.data.words || answer.words;
    const text = named
      ? `${answer.data.kind === 'plug' ? 'plug ' : ''}${answer.data.row} / ${answer.data.column}`
      : 'not known';
    this.pick = { u, v, text, bad: !named, until: performance.now() + PICK_SHOWN_MS };
    this.view.paint();
    this.notify(
      named
        ? `The ${answer.data.kind === 'plug' ? 'plug' : 'tube'} there is row ${answer.data.row}, column ${answer.data.column}.`
        : `No tube is named there: ${why}`,
      named ? '' : 'bad',
    );
  }
}
