// Talks to the box: session, pictures, events, commands. Says what it heard as events; draws
// nothing.
import { PictureClock, judge } from './freshness.js';

const FRAME_TIMEOUT_MS = 4000; // The box answers after 2 s at the latest.
const SILENT_MS = 3000; // No word at all for so long: the line counts as broken.
const RETRY_MS = 500;
const COMPARE_MS = 5000;

const steadyNow = () => performance.now() / 1000;
const wallNow = () => Date.now() / 1000;
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Splits what /api/frame answers: length, sighting, JPEG. */
export async function unpackFrame(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const sighting = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const bitmap = await createImageBitmap(
    new Blob([new Uint8Array(buffer, 4 + length)], { type: 'image/jpeg' }),
  );
  return { sighting, bitmap };
}

/**
 * Events: `session` (it changed), `frame` ({sighting, bitmap}), `status`, `reply`, `operator`,
 * `disagreement`, `log` (each with the box's words as detail).
 */
export class Box extends EventTarget {
  constructor() {
    super();
    this.session = null;
    this.sessionState = 'unknown'; // unknown | open | login
    this.clock = new PictureClock();
    this.last = null; // the last frame
    this.status = null;
    this.asked = 0;
    this.estimates = false; // whether pictures come with where all tubes are expected
    this.heardAt = -Infinity;
    this.broken = false;
  }

  emit(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  /** 'up' while the box answers. */
  get link() {
    return !this.broken && performance.now() - this.heardAt < SILENT_MS ? 'up' : 'down';
  }

  pictureAge() {
    return this.clock.age(steadyNow(), wallNow());
  }

  /** How long before its picture the last field was judged, s. */
  unjudged() {
    const age = this.last && this.last.sighting.age_s;
    return typeof age === 'number' ? Math.max(0, age) : 0;
  }

  /** What may be said of the tube above the guidetube now (see judge()). */
  judgement() {
    return judge({
      session: this.sessionState,
      link: this.link,
      age: this.pictureAge() + this.unjudged(),
      sighting: this.last && this.last.sighting,
    });
  }

  get operating() {
    return Boolean(this.session && this.session.operator && this.session.operator.mine);
  }

  async start() {
    this.listen();
    this.loop();
    await this.refresh();
    setInterval(() => this.compareClocks(), COMPARE_MS);
  }

  /** Where the box's clock stands: a picture's answer waits for the picture, this one does not. */
  async compareClocks() {
    const asked = steadyNow();
    const answer = await this.get('/api/session');
    if (answer.good) {
      this.clock.answered(answer.data.now_s, asked);
      if (this.sessionState === 'open' && answer.data.role === 'none') {
        this.ended();
      }
    }
  }

  /** Asks who we are until the box answers; whoever asks later gets the answer alone. */
  async refresh() {
    this.asked += 1;
    const mine = this.asked;
    while (mine === this.asked) {
      const answer = await this.get('/api/session');
      if (answer.good && mine === this.asked) {
        this.take(answer.data);
        return;
      }
      await pause(RETRY_MS);
    }
  }

  take(session) {
    const boot = this.session && this.session.box && this.session.box.boot;
    if (boot !== undefined && boot !== null && session.box && session.box.boot !== boot) {
      this.forget();
    }
    this.session = session;
    this.sessionState = session.role === 'none' ? 'login' : 'open';
    this.emit('session', session);
  }

  /** What was seen before says nothing any more. */
  forget() {
    this.clock.reset();
    this.last = null;
  }

  ended() {
    if (this.sessionState !== 'login') {
      this.sessionState = 'login';
      this.forget();
      this.emit('session', this.session);
    }
  }

  // Commands. Each returns {good, status, data, words}; never throws.

  get(path) {
    return this.request('GET', path);
  }

  post(path, body = {}) {
    return this.request('POST', path, body);
  }

  async request(method, path, body) {
    const options = { method, credentials: 'same-origin', cache: 'no-store', headers: {} };
    if (body !== undefined) {
      options.headers['Content-Type'] = 'application/json';
      options.headers['X-Tubesight'] = (this.session && this.session.token) || '';
      options.body = JSON.stringify(body);
    }
    try {
      const answer = await fetch(path, options);
      this.heard();
      const text = await answer.text();
      const data = text ? JSON.parse(text) : {};
      if (answer.status === 401) {
        this.ended();
      }
      return {
        good: answer.ok,
        status: answer.status,
        data,
        words: data.error || `The box answered ${answer.status}.`,
      };
    } catch (error) {
      return { good: false, status: 0, data: {}, words: 'The box did not answer.' };
    }
  }

  /** A picture with its sighting, or null. */
  async picture(path) {
    try {
      const answer = await fetch(path, { credentials: 'same-origin', cache: 'no-store' });
      return answer.ok ? await unpackFrame(await answer.arrayBuffer()) : null;
    } catch (error) {
      return null;
    }
  }

  heard() {
    this.heardAt = performance.now();
    this.broken = false;
  }

  // Pictures: the next is asked for when the last is drawn, so that a slow line shows few
  // pictures, but no old ones.

  async loop() {
    for (;;) {
      if (this.sessionState !== 'open') {
        await pause(100);
        continue;
      }
      const wait = await this.once();
      if (wait === 0) {
        await this.drawn();
      } else {
        await pause(wait);
      }
    }
  }

  drawn() {
    if (document.hidden) {
      return pause(250);
    }
    return new Promise((done) => requestAnimationFrame(() => done()));
  }

  /** Asks for one picture; returns how long to wait before the next, ms. */
  async once() {
    const after = this.last ? this.last.sighting.field : -1;
    const asked = steadyNow();
    const stop = new AbortController();
    const timer = setTimeout(() => stop.abort(), FRAME_TIMEOUT_MS);
    try {
      const answer = await fetch(
        `/api/frame?after=${after}${this.estimates ? '&estimates=1' : ''}`,
        {
          credentials: 'same-origin',
          cache: 'no-store',
          signal: stop.signal,
        },
      );
      if (answer.status === 401 || answer.status === 403) {
        this.ended();
        return RETRY_MS;
      }
      if (answer.status === 204) {
        this.heard();
        return 10;
      }
      if (!answer.ok) {
        this.broken = true;
        return RETRY_MS;
      }
      const buffer = await answer.arrayBuffer();
      const steady = steadyNow();
      const wall = wallNow();
      const frame = await unpackFrame(buffer);
      if (this.sessionState !== 'open') {
        return RETRY_MS;
      }
      this.heard();
      this.clock.came(frame.sighting, asked, steady, wall);
      if (this.last) {
        this.last.bitmap.close();
      }
      this.last = frame;
      this.emit('frame', frame);
      return 0;
    } catch (error) {
      this.broken = true;
      return RETRY_MS;
    } finally {
      clearTimeout(timer);
    }
  }

  // Events.

  listen() {
    const source = new EventSource('/api/events');
    for (const name of ['status', 'reply', 'operator', 'disagreement', 'log']) {
      source.addEventListener(name, (event) => {
        let detail;
        try {
          detail = JSON.parse(event.data);
        } catch (error) {
          return;
        }
        if (name === 'status') {
          this.status = detail;
        }
        if (name === 'operator' && this.session) {
          this.session.operator = detail;
        }
        if (name === 'operator') {
          this.refresh(); // An answer on its way may be from before this.
        }
        this.emit(name, detail);
      });
    }
    source.onerror = () => {
      // Closed for good by an answer that is no stream (the session has ended, the box is
      // starting): ask anew.
      if (source.readyState === EventSource.CLOSED) {
        setTimeout(() => this.listen(), 2000);
      }
    };
    source.onopen = () => {
      if (this.sessionState === 'open') {
        this.refresh();
      }
    };
  }
}
