// A camera's picture on one canvas and the marks on another, sharp at any size and pixel ratio.
import { make } from './dom.js';
import { ageWords } from './freshness.js';

/**
 * Fills its host. Full-frame pixels (u, v) and the host's CSS pixels (x, y): x = left + (u + 0.5)
 * * scale, the centre of the first pixel being (0, 0).
 */
export class PictureView {
  constructor({ label, width = 640, height = 480 }) {
    this.base = make('canvas', { class: 'base', 'aria-hidden': 'true' });
    this.marks = make('canvas', { class: 'marks', 'aria-hidden': 'true' });
    this.age = make('p', { class: 'age', hidden: true });
    this.host = make(
      'div',
      { class: 'picture', tabindex: '0', role: 'application', 'aria-label': label },
      this.base,
      this.marks,
      this.age,
    );
    this.width = width;
    this.height = height;
    this.bitmap = null;
    this.painter = null;
    this.scale = 1;
    this.left = 0;
    this.top = 0;
    new ResizeObserver(() => this.paint()).observe(this.host);
  }

  /** Shows a picture; `painter(ctx, view)` draws the marks over it in CSS pixels. */
  show(bitmap, painter) {
    this.bitmap = bitmap;
    if (bitmap) {
      this.width = bitmap.width;
      this.height = bitmap.height;
    }
    this.painter = painter;
    this.paint();
  }

  /** The age shown over the picture, or null while it is new. An old picture has no marks. */
  setOld(age) {
    const old = age !== null;
    const changed = this.host.classList.contains('old') !== old;
    this.host.classList.toggle('old', old);
    this.age.hidden = !old;
    this.age.textContent = !old
      ? ''
      : Number.isFinite(age)
        ? `OLD PICTURE: ${ageWords(age)}`
        : 'NO PICTURE';
    if (changed) {
      this.paint();
    }
  }

  fit(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(this.host.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.host.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const context = canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.host.clientWidth, this.host.clientHeight);
    return context;
  }

  paint() {
    if (!this.host.isConnected || this.host.clientWidth === 0) {
      return;
    }
    this.scale = Math.min(this.host.clientWidth / this.width, this.host.clientHeight / this.height);
    this.left = (this.host.clientWidth - this.width * this.scale) / 2;
    this.top = 0;
    const base = this.fit(this.base);
    if (this.bitmap && this.bitmap.width > 0) {
      base.imageSmoothingQuality = 'high';
      base.drawImage(
        this.bitmap,
        this.left,
        this.top,
        this.width * this.scale,
        this.height * this.scale,
      );
    }
    const marks = this.fit(this.marks);
    if (this.painter && !this.host.classList.contains('old')) {
      marks.save();
      marks.beginPath();
      marks.rect(this.left, this.top, this.width * this.scale, this.height * this.scale);
      marks.clip();
      this.painter(marks, this);
      marks.restore();
    }
  }

  toScreen(u, v) {
    return [this.left + (u + 0.5) * this.scale, this.top + (v + 0.5) * this.scale];
  }

  toFrame(x, y) {
    return { u: (x - this.left) / this.scale - 0.5, v: (y - this.top) / this.scale - 0.5 };
  }

  /** Where on the frame a pointer event is, or null beside the picture. */
  at(event) {
    const box = this.host.getBoundingClientRect();
    const place = this.toFrame(event.clientX - box.left, event.clientY - box.top);
    const inside =
      place.u >= -0.5 &&
      place.v >= -0.5 &&
      place.u <= this.width - 0.5 &&
      place.v <= this.height - 0.5;
    return inside ? place : null;
  }
}

/**
 * The place of `places` ({u, v}) that an arrow key leads to from `from`: the nearest within 60
 * degrees of it, or null.
 */
export function nextPlace(places, from, key) {
  const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
  let best = null;
  let least = Infinity;
  for (const place of places) {
    const du = place.u - from.u;
    const dv = place.v - from.v;
    const along = du * way[0] + dv * way[1];
    const across = Math.abs(du * way[1]) + Math.abs(dv * way[0]);
    if (along < 2 || across > 1.7 * along) {
      continue;
    }
    if (along + 2 * across < least) {
      least = along + 2 * across;
      best = place;
    }
  }
  return best;
}

/** The place of `places` nearest to (u, v), or null where none is within `within` px. */
export function nearestPlace(places, { u, v }, within = Infinity) {
  let best = null;
  let least = within;
  for (const place of places) {
    const distance = Math.hypot(place.u - u, place.v - v);
    if (distance <= least) {
      least = distance;
      best = place;
    }
  }
  return best;
}
