// Screenshots compared with kept ones: a third or half of their size and in few colours, so that they are
// small and a new version of the browser or of a font does not change them.
import fs from 'node:fs';
import path from 'node:path';
import { check, HERE, PNG, ROOT } from './harness.mjs';

const FOLDER = path.join(HERE, 'golden');
const STEP = 17; // 16 levels a colour
const BLOCK = 8;
const MOST_DIFFERENCE = 26; // mean of a block, of 255
const MOST_BLOCKS = 0.006; // share of blocks that may differ more
const MOST_TRIES = 4;

/** Makes a picture smaller by a whole number, by means, and rounds its colours. */
export function reduce(png, by) {
  const width = Math.floor(png.width / by);
  const height = Math.floor(png.height / by);
  const small = new PNG({ width, height });
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      for (let channel = 0; channel < 3; channel += 1) {
        let sum = 0;
        for (let dy = 0; dy < by; dy += 1) {
          for (let dx = 0; dx < by; dx += 1) {
            sum += png.data[4 * ((y * by + dy) * png.width + x * by + dx) + channel];
          }
        }
        small.data[4 * (y * width + x) + channel] = Math.round(sum / by / by / STEP) * STEP;
      }
      small.data[4 * (y * width + x) + 3] = 255;
    }
  }
  return small;
}

/** The share of blocks whose mean differs too much. */
export function differing(one, other) {
  if (one.width !== other.width || one.height !== other.height) {
    return 1;
  }
  let blocks = 0;
  let bad = 0;
  for (let top = 0; top + BLOCK <= one.height; top += BLOCK) {
    for (let left = 0; left + BLOCK <= one.width; left += BLOCK) {
      const sums = [0, 0, 0];
      for (let y = top; y < top + BLOCK; y += 1) {
        for (let x = left; x < left + BLOCK; x += 1) {
          const at = 4 * (y * one.width + x);
          for (let channel = 0; channel < 3; channel += 1) {
            sums[channel] += one.data[at + channel] - other.data[at + channel];
          }
        }
      }
      blocks += 1;
      bad += Math.max(...sums.map(Math.abs)) / (BLOCK * BLOCK) > MOST_DIFFERENCE ? 1 : 0;
    }
  }
  return bad / blocks;
}

export function kept(name) {
  return PNG.sync.read(fs.readFileSync(path.join(FOLDER, `${name}.png`)));
}

/** The screenshots of docs/operator.md, made anew by --pictures. */
const SHOWN = ['live-1024', 'live-between', 'live-frozen', 'start-1024', 'start-refused', 'disagreement-1024', 'sheet-1024'];

/** Compares the page with the kept picture `name`, or keeps it when the test is run with --update. */
export async function compare(page, name, masked = []) {
  const take = async () => {
    const shot = await page.screenshot({ animations: 'allow', mask: masked.map((each) => page.locator(each)), maskColor: '#404040' });
    const png = PNG.sync.read(shot);
    return { shot, small: reduce(png, png.width > 1100 ? 3 : 2) };
  };
  const encode = (small) => PNG.sync.write(small, { colorType: 2, deflateLevel: 9 });
  if (process.argv.includes('--pictures') && SHOWN.includes(name)) {
    const shown = path.join(ROOT, `docs/pictures/page-${name.replace('-1024', '')}.jpg`);
    await page.screenshot({ animations: 'allow', path: shown, type: 'jpeg', quality: 72 });
  }
  let last = await take();
  if (process.argv.includes('--update')) {
    // What is kept is what stood twice: no moment in which a picture was late.
    for (let before = null; before === null || !before.data.equals(last.small.data);) {
      before = last.small;
      await page.waitForTimeout(600);
      last = await take();
    }
    fs.mkdirSync(FOLDER, { recursive: true });
    fs.writeFileSync(path.join(FOLDER, `${name}.png`), encode(last.small));
    return;
  }
  // On a busy computer a picture may be late, which the page rightly shows.
  let share = differing(last.small, kept(name));
  for (let more = 0; more < MOST_TRIES && share > MOST_BLOCKS; more += 1) {
    await page.waitForTimeout(700);
    last = await take();
    share = differing(last.small, kept(name));
  }
  if (share > MOST_BLOCKS) {
    const saved = path.join(process.env.TMPDIR || '/tmp', `page-${name}.png`);
    fs.writeFileSync(saved, last.shot);
    check(false, `${name}: ${(100 * share).toFixed(1)} % of the picture differs from golden/${name}.png; see ${saved}`);
  }
}
