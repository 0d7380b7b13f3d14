#!/usr/bin/env node
// The operator's page in a real browser, against the mock box.
//
// Usage: page_test.mjs [--update] [--pictures] [--only WORDS]
//
// --update keeps new golden screenshots, --pictures those of docs/operator.md: look at them.
import fs from 'node:fs';
import { chromium, startMock } from './harness.mjs';
import { flows } from './flows.mjs';
import { freshness } from './freshness_cases.mjs';
import { looks } from './looks.mjs';

const AT_ONCE = 2;

const only = process.argv.includes('--only') ? process.argv[process.argv.indexOf('--only') + 1] : '';
const tests = Object.entries({ ...freshness, ...flows, ...looks }).filter(([name]) => name.includes(only));
if (!fs.existsSync('/usr/bin/chromium-headless-shell')) {
  console.error('page_test: there is no /usr/bin/chromium-headless-shell; scripts/install_packages.sh test installs it');
  process.exit(1);
}
const mock = await startMock();
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium-headless-shell', args: ['--no-sandbox', '--disable-gpu'] });
const base = `http://127.0.0.1:${mock.port}`;
let failed = 0;
const queue = [...tests];
await Promise.all(Array.from({ length: AT_ONCE }, async () => {
  for (let next = queue.shift(); next; next = queue.shift()) {
    const [name, test] = next;
    const begun = performance.now();
    const contexts = [];
    try {
      await test({ newContext: async (options) => {
        const context = await browser.newContext(options);
        contexts.push(context);
        return context;
      } }, base);
      console.log(`ok      ${name} (${Math.round(performance.now() - begun)} ms)`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${name}: ${error.message.split('\n').slice(0, 3).join(' ').slice(0, 400)}`);
    }
    await Promise.all(contexts.map((context) => context.close()));
  }
}));
await browser.close();
mock.stop();
console.log(`page_test: ${tests.length} tests, ${failed} failed`);
process.exit(failed || !tests.length ? 1 : 0);
