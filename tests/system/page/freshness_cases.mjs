// What may be said of the tube, by tables: no browser is needed for it.
import { check, equal, ROOT } from './harness.mjs';

const { judge, PictureClock, ageWords } = await import(`${ROOT}/drivers/web/page/freshness.js`);
const { addressOf, threeTubes, waysToChoose } = await import(`${ROOT}/drivers/web/page/numbering.js`);

const good = {
  session: 'open',
  link: 'up',
  age: 0.05,
  sighting: { state: 'tracking', aligned: true, judged: true, tool: { row: 40, column: 60 } },
};

function near(found, expected, words) {
  check(Math.abs(found - expected) < 1e-9, `${words}: expected ${expected}, found ${found}`);
}

export const freshness = {
  'judge: vouches only when all that it takes is there': () => {
    equal(judge(good).standing, 'vouched', 'all is well');
    const but = (change) => judge({ ...good, ...change }).standing;
    const seen = (change) => but({ sighting: { ...good.sighting, ...change } });
    equal(but({ session: 'login' }), 'unknown', 'the session ended');
    equal(but({ session: undefined }), 'unknown', 'no session');
    equal(but({ link: 'down' }), 'unknown', 'no link');
    equal(but({ age: 0.51 }), 'unknown', 'an old picture');
    equal(but({ age: NaN }), 'unknown', 'an age that is no number');
    equal(but({ age: Infinity }), 'unknown', 'no age');
    equal(but({ sighting: null }), 'unknown', 'no sighting');
    equal(seen({ state: 'lost' }), 'unknown', 'lost, though a tube is named');
    equal(seen({ state: 'waiting' }), 'unknown', 'waiting');
    equal(seen({ state: 'something new' }), 'unknown', 'a state that the page does not know');
    equal(seen({ state: undefined }), 'unknown', 'no state');
    equal(seen({ tool: undefined }), 'none', 'no tube');
    equal(seen({ tool: { row: 40 } }), 'none', 'half an address');
    equal(seen({ aligned: false }), 'seen', 'not aligned');
    equal(seen({ aligned: undefined }), 'seen', 'no word on it');
    equal(seen({ aligned: 1 }), 'seen', 'a word that is not true');
    equal(seen({ judged: false }), 'seen', 'not judged');
  },
  'judge: no address leaves it where the tube is not known': () => {
    const found = judge({ ...good, age: 9 });
    check(found.row === undefined && found.column === undefined, 'an address of an old picture');
  },
  'clock: a picture ages by the time since it came': () => {
    const clock = new PictureClock();
    equal(clock.age(0, 0), Infinity, 'no picture');
    clock.came({ time_s: 999.96, now_s: 1000 }, 50, 50.01, 9000);
    near(clock.age(50.01, 9000), 0.05, 'when it comes');
    near(clock.age(52.01, 9002), 2.05, 'two seconds on');
    near(clock.age(50.01, 9600), 600.05, 'after a sleep that one clock did not count');
  },
  'clock: pictures held up on the way are old, even when all are': () => {
    const late = new PictureClock();
    late.came({ time_s: 999.96, now_s: 1000 }, 50, 53, 9003);
    check(late.age(53, 9003) > 3, 'the first picture, held up for 3 s');
    const queued = new PictureClock();
    queued.came({ time_s: 999.96, now_s: 1000 }, 50, 50.01, 9000);
    queued.came({ time_s: 1000.06, now_s: 1000.1 }, 50.1, 52.1, 9002.1);
    near(queued.age(52.1, 9002.1), 2.04, 'one picture held up');
  },
  'clock: a slow camera is not taken for a slow line': () => {
    const clock = new PictureClock();
    clock.answered(1000, 49.99);
    clock.came({ time_s: 1000.46, now_s: 1000.5 }, 50, 50.5, 9000.5);
    near(clock.age(50.5, 9000.5), 0.05, 'a picture that was waited for');
  },
  'clock: a box started anew is not judged by its old clock': () => {
    const clock = new PictureClock();
    clock.came({ time_s: 89999.96, now_s: 90000 }, 50, 50.01, 9000);
    clock.came({ time_s: 2.96, now_s: 3 }, 80, 80.01, 9030);
    near(clock.age(80.01, 9030), 0.05, 'after a restart');
  },
  'clock: what carries no time is old': () => {
    const clock = new PictureClock();
    clock.came({ now_s: 3 }, 1, 1, 1);
    equal(clock.age(1, 1), Infinity, 'no time of its own');
    clock.came({ time_s: 3 }, 1, 1, 1);
    equal(clock.age(1, 1), Infinity, 'no clock');
  },
  'age: in words': () => {
    equal([0.04, 3.21, 45.9, 200, Infinity].map(ageWords), ['0.0 s', '3.2 s', '45 s', '3 min', 'no picture'], 'words');
  },
  'numbering: addresses follow from one, by the way chosen': () => {
    const anchor = { i: 3, j: -1, u: 0, v: 0 };
    const turned = { a: 0, b: 1, c: -1, d: 0 };
    equal(addressOf({ i: 4, j: 1 }, anchor, { row: 40, column: 60 }, turned), { row: 42, column: 59 }, 'turned');
    equal(addressOf(anchor, anchor, { row: 40, column: 60 }, turned), { row: 40, column: 60 }, 'itself');
  },
  'numbering: three tube-ends of a start are not in one line': () => {
    const line = [0, 1, 2].map((i) => ({ i, j: 0, u: 10 * i, v: 0 }));
    equal(threeTubes(line, line[0]), null, 'only a line');
    const off = { i: 0, j: 1, u: 0, v: 30 };
    equal(threeTubes([...line, off], line[0]), [line[0], line[1], off], 'one beside it');
  },
  'numbering: what the settings leave comes before all ways': () => {
    const ways = [{ a: 1 }, { a: 2, likely: true }];
    equal(waysToChoose({ found: true, ways }), [ways[1]], 'one is likely');
    equal(waysToChoose({ found: true, ways: [ways[0]] }), [ways[0]], 'none is');
    equal(waysToChoose({ found: false, ways }), [], 'nothing found');
  },
};
