// The tube above the guidetube, to be read from two metres: its address and whether the box
// vouches for it.
import { digits, make, tell } from './dom.js';
import { OLD_S } from './freshness.js';

const TITLES = { vouched: 'VOUCHED', seen: 'NOT VOUCHED', none: 'NO TUBE', unknown: 'NOT KNOWN' };
const SIGNS = { vouched: '✓', seen: '≠', none: '○', unknown: '?' };
const CLAIMS = { confirmed: 'CONFIRMED', contradicted: 'CONTRADICTED', unknown: 'NOT ANSWERED' };

/**
 * It says NOT KNOWN until it is told better, and again when nothing came for a second: a cover
 * comes down by an animation that runs outside of the page's own thread, so even a page that
 * hangs stops vouching.
 */
export class TubePanel {
  constructor() {
    this.sign = make('span', { class: 'sign', 'aria-hidden': 'true' });
    this.title = make('span', {});
    this.row = make('span', { class: 'number' });
    this.column = make('span', { class: 'number' });
    this.address = make(
      'div',
      { class: 'address' },
      make('p', {}, make('span', { class: 'label' }, 'ROW'), this.row),
      make('p', {}, make('span', { class: 'label' }, 'COL'), this.column),
    );
    this.offset = make('span', { class: 'offset' });
    this.dial = make('canvas', { class: 'dial', 'aria-hidden': 'true' });
    this.cover = make(
      'div',
      { class: 'cover', 'aria-hidden': 'true' },
      make('p', {}, '? NOT KNOWN'),
      make('p', {}, 'Nothing comes in.'),
    );
    this.claim = make('p', { class: 'claim' });
    this.tube = make(
      'div',
      { class: 'tube', role: 'status', 'aria-live': 'polite', 'data-standing': 'unknown' },
      make('h2', { class: 'title' }, this.sign, this.title),
      this.address,
      this.cover,
    );
    this.element = make(
      'div',
      { class: 'tube-panel' },
      this.tube,
      make('div', { class: 'offset-line' }, this.dial, this.offset),
      this.claim,
    );
    this.falling = this.cover.animate(
      [{ opacity: 0 }, { opacity: 0, offset: 0.98 }, { opacity: 1 }],
      { duration: 1000 * (OLD_S + 0.7), fill: 'both' },
    );
    this.falling.finish();
    this.show({ standing: 'unknown' }, null);
  }

  /** A picture came: the cover stays up a little longer. */
  alive() {
    this.falling.currentTime = 0;
    this.falling.play();
  }

  show(judgement, sighting) {
    const { standing } = judgement;
    this.tube.dataset.standing = standing;
    tell(this.sign, SIGNS[standing]);
    tell(this.title, TITLES[standing]);
    const named = standing === 'vouched' || standing === 'seen';
    tell(this.row, named ? String(judgement.row) : '–');
    tell(this.column, named ? String(judgement.column) : '–');
    const tool = named && sighting ? sighting.tool : null;
    tell(this.offset, tool ? `${digits(tool.offset_mm, 1)} mm off its centre` : 'offset not known');
    this.drawDial(tool);
    this.showClaim(sighting && sighting.claim, standing === 'unknown');
  }

  showClaim(claim, old) {
    if (old) {
      this.claim.dataset.verdict = 'none';
      tell(this.claim, 'What the robot says is not known.');
      return;
    }
    this.claim.dataset.verdict = claim ? claim.verdict : 'none';
    const verdict = claim ? CLAIMS[claim.verdict] || String(claim.verdict).toUpperCase() : '';
    tell(
      this.claim,
      claim
        ? `Robot says ${claim.row} / ${claim.column}: ${verdict}`
        : 'The robot has claimed no tube.',
    );
  }

  /**
   * The ring is what counts as under the tube; the arrow leads to where the axis is, as seen in
   * the picture.
   */
  drawDial(tool) {
    const size = 56;
    const ratio = window.devicePixelRatio || 1;
    if (this.dial.width !== size * ratio) {
      this.dial.width = size * ratio;
      this.dial.height = size * ratio;
    }
    const ctx = this.dial.getContext('2d');
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, size, size);
    const middle = size / 2;
    const ring = 17;
    ctx.lineWidth = 2.5;
    ctx.strokeStyle = '#b3bcc6';
    ctx.beginPath();
    ctx.arc(middle, middle, ring, 0, 2 * Math.PI);
    ctx.stroke();
    if (!tool || typeof tool.offset_mm !== 'number' || typeof tool.direction_deg !== 'number') {
      return;
    }
    const long = Math.min(22, (tool.offset_mm / (tool.within_mm || 2.5)) * ring);
    const angle = (tool.direction_deg * Math.PI) / 180;
    const end = [middle + long * Math.cos(angle), middle + long * Math.sin(angle)];
    ctx.strokeStyle = '#ffffff';
    ctx.fillStyle = '#ffffff';
    ctx.lineWidth = 3;
    ctx.beginPath();
    ctx.moveTo(middle, middle);
    ctx.lineTo(...end);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(...end, 4.5, 0, 2 * Math.PI);
    ctx.fill();
  }
}
