#!/usr/bin/env node
// How late the operator's page is: from a field's mid-exposure, by the box's clock, to the frame in which a real browser draws it.
//
// Usage: TUBESIGHT_PAGE_MODULES=build/page-test page_latency.mjs URL [SECONDS]
//
// URL: of a box on this machine that asks no password (docs/examples/box-with-page.toml). The box stamps each sighting with the
// field's instant (time_s) and with its clock when it sent it (now_s). Where its clock stands on the browser's is taken from
// questions that are answered at once: no answer is made before it is asked for, so that what is printed is never too low, and
// too high by the way of the fastest question at most. Drawn: the second animation frame behind the one in which the page took
// the picture.
import { createRequire } from 'node:module';
import path from 'node:path';

const [url, seconds = '10'] = process.argv.slice(2);
if (!url || !process.env.TUBESIGHT_PAGE_MODULES) {
  console.error('page_latency: expected URL, and TUBESIGHT_PAGE_MODULES in the environment');
  process.exit(2);
}
const require = createRequire(path.resolve(process.env.TUBESIGHT_PAGE_MODULES, 'package.json'));
const { chromium } = require('playwright-core');
const browser = await chromium.launch({
  executablePath: '/usr/bin/chromium-headless-shell', args: ['--no-sandbox', '--disable-gpu'],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(url, { waitUntil: 'domcontentloaded' });
await page.waitForTimeout(2000);
const offset = await page.evaluate(async () => {
  let least = -Infinity;
  for (let k = 0; k < 40; k += 1) {
    const asked = performance.now() / 1000;
    const bytes = await (await fetch('/api/frame?after=-1&quality=10')).arrayBuffer();
    const length = new DataView(bytes).getUint32(0, true);
    const { now_s: sent } = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
    least = Math.max(least, asked - sent);
  }
  return least;
});
const rows = await page.evaluate((ms) => new Promise((done) => {
  const seen = [];
  const { box } = globalThis.tubesight;
  box.addEventListener('frame', ({ detail }) => {
    const came = performance.now() / 1000;
    const { time_s: taken, now_s: sent, field } = detail.sighting;
    requestAnimationFrame(() => requestAnimationFrame(() => {
      seen.push({ field, taken, sent, came, drawn: performance.now() / 1000 });
    }));
  });
  setTimeout(() => done(seen), ms);
}), 1000 * Number(seconds));
await browser.close();
if (rows.length < 10) {
  console.error(`page_latency: only ${rows.length} pictures came`);
  process.exit(1);
}
const quantiles = (name, of) => {
  const all = rows.map(of).sort((a, b) => a - b);
  const at = (share) => (1000 * all[Math.min(all.length - 1, Math.floor(share * all.length))]).toFixed(1).padStart(8);
  console.log(`${name.padEnd(46)}${at(0.5)}${at(0.95)}${at(1)}`);
};
console.log(`${rows.length} pictures in ${seconds} s${''.padEnd(20)} median, 95 %, worst, ms`);
quantiles('mid-exposure to sent, the box', (row) => row.sent - row.taken);
quantiles('sent to unpacked: line and decoding', (row) => row.came - row.sent - offset);
quantiles('unpacked to drawn, the browser', (row) => row.drawn - row.came);
quantiles('mid-exposure to drawn, at most', (row) => row.drawn - offset - row.taken);
