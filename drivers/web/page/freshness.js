// What the page may say about the tube above the guidetube. The answer is "not known" unless all
// that it takes is there.

/** A picture older than this says nothing about where the tool is now, s. */
export const OLD_S = 0.5;

/** How long a bound counts, s. Two clocks drift apart by 100 ppm at most: 6 ms in that time. */
const KEPT_S = 60;

/**
 * How old a picture is, by the box's clock and by ours: age when it was sent, time on the way, time
 * since it came.
 *
 * The time on the way follows from where the box's clock stands on ours. An answer was made after
 * it was asked for, which bounds that from below; the greatest such bound of the last minute is
 * taken, so that an age is never told too low: not for pictures held up on the way, nor where every
 * answer is late by the same time. Times of this side are taken from two clocks, as one of them
 * stands still while a laptop sleeps and the other one may be set.
 */
export class PictureClock {
  constructor() {
    this.reset();
  }

  reset() {
    this.offset = -Infinity; // ours minus the box's, s, at the least: of this half minute,
    this.offsetBefore = -Infinity; // and of the one before
    this.since = null;
    this.picture = null;
    this.lastNow = null;
  }

  /** The box's clock stood at `now` when it answered what we asked at `asked` (ours, steady), s. */
  answered(now, asked) {
    if (typeof now !== 'number') {
      return;
    }
    if (this.lastNow !== null && now < this.lastNow - 1) {
      this.reset(); // The box was started anew.
    }
    this.lastNow = now;
    if (this.since === null || asked - this.since > KEPT_S / 2) {
      this.offsetBefore = this.offset;
      this.offset = -Infinity;
      this.since = asked;
    }
    this.offset = Math.max(this.offset, asked - now);
  }

  /**
   * A picture came: when it was taken and when it was sent, by the box's clock; when we asked for
   * it and have it, by our `steady` clock and the `wall` clock; all s.
   */
  came({ time_s: taken, now_s: now }, asked, steady, wall) {
    this.answered(now, asked);
    const known = typeof taken === 'number' && typeof now === 'number';
    this.picture = { age: known ? now - taken : Infinity, now, steady, wall };
  }

  /** The picture's age at an instant of ours, s; Infinity where there is none. */
  age(steady, wall) {
    const { picture } = this;
    if (!picture) {
      return Infinity;
    }
    const since = Math.max(steady - picture.steady, wall - picture.wall, 0);
    const offset = Math.max(this.offset, this.offsetBefore);
    const onTheWay =
      typeof picture.now === 'number' ? picture.steady - offset - picture.now : Infinity;
    return Math.max(0, picture.age) + Math.max(0, onTheWay) + since;
  }
}

/** An age in words that a person reads at a glance. */
export function ageWords(age) {
  if (!Number.isFinite(age)) {
    return 'no picture';
  }
  if (age < 10) {
    return `${age.toFixed(1)} s`;
  }
  return age < 120 ? `${Math.floor(age)} s` : `${Math.floor(age / 60)} min`;
}

const notKnown = (words, advice) => ({ standing: 'unknown', words, advice });

function isTube(tool) {
  return tool && Number.isInteger(tool.row) && Number.isInteger(tool.column);
}

/**
 * What may be said now. `session`: 'open' or else; `link`: 'up' or else; `age`: s; `sighting`:
 * the last one. Returns {standing, row, column, words, advice}: standing is 'vouched' (the box
 * answers for this tube), 'seen' (a tube, but nobody answers for it), 'none' (no tube there) or
 * 'unknown' (no address is shown).
 */
export function judge({ session, link, age, sighting }) {
  if (session !== 'open') {
    return notKnown('The session has ended', 'Log in again.');
  }
  if (link !== 'up') {
    return notKnown(
      'No connection to the box',
      'Look at the network cable and at the box. The page tries again by itself.',
    );
  }
  if (!sighting) {
    return notKnown(
      'No picture has come yet',
      'Wait; if none comes, look at the camera and its cable.',
    );
  }
  if (!(age <= OLD_S)) {
    return notKnown(
      `The picture is old: ${ageWords(age)}`,
      sighting.camera && sighting.camera.words && sighting.camera.words !== 'well'
        ? `Camera: ${sighting.camera.words}.`
        : 'Do not move by it. Look at the camera and its cable.',
    );
  }
  const words =
    sighting.words && sighting.words.toLowerCase() !== sighting.state ? sighting.words : '';
  const advice = sighting.advice || '';
  if (sighting.state !== 'tracking' && sighting.state !== 'degraded') {
    return notKnown(
      words ||
        (sighting.state === 'waiting' ? 'No start yet' : 'The box does not know where the tool is'),
      advice || 'Start: name a tube-end.',
    );
  }
  if (!isTube(sighting.tool)) {
    return { standing: 'none', words: words || 'No tube above the guidetube', advice };
  }
  const { row, column } = sighting.tool;
  if (sighting.aligned === true && sighting.judged !== false) {
    const claim =
      sighting.claim && sighting.claim.verdict === 'contradicted' ? sighting.claim : null;
    return {
      standing: 'vouched',
      row,
      column,
      words: claim
        ? claim.words || `The robot says ${claim.row} / ${claim.column}, which is another tube`
        : words || 'The box vouches for this tube',
      advice: claim ? 'Let nothing be done to this tube. Look under Disagreement.' : advice,
    };
  }
  return {
    standing: 'seen',
    row,
    column,
    words: words || 'Nearest tube; the guidetube is not under it',
    advice,
  };
}
