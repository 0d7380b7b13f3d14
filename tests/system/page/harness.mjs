// What the page's tests share: the mock box, one browser, a page with a session of its own, pictures.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

export const HERE = import.meta.dirname || path.dirname(new URL(import.meta.url).pathname);
export const ROOT = path.resolve(HERE, '../../..');
export const MODULES = process.env.TUBESIGHT_PAGE_MODULES || path.join(ROOT, 'build/page-test');
const require = createRequire(path.join(MODULES, 'package.json'));
export const { chromium } = require('playwright-core');
export const { PNG } = require('pngjs');
export const AXE = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

export function check(condition, words) {
  if (!condition) {
    throw new Error(words);
  }
}

export function equal(found, expected, words) {
  const [a, b] = [JSON.stringify(found), JSON.stringify(expected)];
  check(a === b, `${words}: expected ${b}, found ${a}`);
}

// A computer with other work is slow, and no test waits for what does not come.
const TIMEOUT_MS = 20000;

/** Starts the mock box; resolves to {port, stop}. */
export function startMock() {
  const process = spawn('python3', ['-B', path.join(HERE, 'mock_box.py'), '--root', ROOT], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  return new Promise((resolve, reject) => {
    process.on('exit', (status) => reject(new Error(`mock_box.py ended with ${status}`)));
    process.stdout.on('data', (text) => {
      const port = /listening on (\d+)/.exec(text);
      if (port) {
        resolve({ port: Number(port[1]), stop: () => process.kill() });
      }
    });
  });
}

/** A page with a session of its own, and what went wrong in it. */
export class Visit {
  static async open(browser, base, { scene = 'aligned', width = 1024, height = 768, touch = false, hash = '' } = {}) {
    const visit = new Visit();
    visit.base = base;
    visit.context = await browser.newContext({
      viewport: { width, height },
      hasTouch: touch,
      acceptDownloads: true,
      reducedMotion: 'no-preference',
    });
    visit.page = await visit.context.newPage();
    visit.page.setDefaultTimeout(TIMEOUT_MS);
    visit.trouble = [];
    visit.page.on('pageerror', (error) => visit.trouble.push(`error in the page: ${error.message}`));
    visit.page.on('console', (message) => {
      // What a browser says of answers that are no success is what those tests are about.
      if (['error', 'warning'].includes(message.type()) && !/Failed to load resource/.test(message.text())) {
        visit.trouble.push(`console: ${message.text()}`);
      }
    });
    visit.page.on('request', (request) => {
      if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(`${base}/`)) {
        visit.trouble.push(`asked for ${request.url()}, which is not the box`);
      }
    });
    // The cookie first, then the scene, then the page: it never sees another scene.
    const first = await visit.context.request.get(`${base}/`);
    check(first.ok(), 'the mock box serves no page');
    await visit.mock({ scene });
    await visit.page.goto(`${base}/${hash}`, { waitUntil: 'domcontentloaded' });
    return visit;
  }

  async mock(wish) {
    await this.context.request.post(`${this.base}/mock`, { data: wish });
  }

  /** What the page posted so far to a path. */
  async posted(name) {
    const answer = await this.context.request.get(`${this.base}/mock`);
    return (await answer.json()).asked.filter(([where]) => where === name).map(([, body]) => body);
  }

  async operate(name = 'Ada') {
    await this.mock({ operator: { held: true, mine: true, name } });
    await this.page.getByRole('button', { name: `You operate (${name})` }).waitFor();
  }

  go(name) {
    return this.page.getByRole('navigation').getByRole('button', { name }).click();
  }

  /** Waits until the tube's panel stands so: vouched, seen, none or unknown. */
  async standing(expected, timeout = TIMEOUT_MS) {
    await this.page.locator(`.live .tube[data-standing="${expected}"]`).waitFor({ timeout });
  }

  /** Clicks the frame's place (u, v) on the picture of a screen. */
  async click(screen, u, v, { tap = false } = {}) {
    const box = await this.page.locator(`.${screen} .picture`).boundingBox();
    const scale = Math.min(box.width / 635, box.height / 480);
    const x = box.x + (box.width - 635 * scale) / 2 + (u + 0.5) * scale;
    const y = box.y + (v + 0.5) * scale;
    await (tap ? this.page.touchscreen.tap(x, y) : this.page.mouse.click(x, y));
  }

  async close() {
    await this.context.close();
    check(this.trouble.length === 0, this.trouble.slice(0, 3).join('; '));
  }
}

/** Waits until a function of the page is true. (Playwright's own needs eval, which the page's policy forbids.) */
export async function until(page, condition) {
  const end = Date.now() + TIMEOUT_MS;
  while (!(await page.evaluate(condition))) {
    check(Date.now() < end, `it never came to ${condition}`);
    await page.waitForTimeout(50);
  }
}

/** What an accessibility checker finds, in one line each. */
export async function accessibility(page) {
  await page.evaluate(AXE);
  return page.evaluate(async () => {
    const found = await globalThis.axe.run(document, { resultTypes: ['violations'] });
    return found.violations.map((each) => `${each.id}: ${each.nodes.map((node) => node.target.join(' ')).slice(0, 3).join(', ')}`);
  });
}
