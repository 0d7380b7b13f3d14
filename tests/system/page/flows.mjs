// What people do with the page, and what must not happen to them.
import fs from 'node:fs';
import { accessibility, check, equal, until, Visit } from './harness.mjs';

/** How long the page may go on vouching after the last picture came, ms: 0.5 s, and a tick of the page's. */
const MOST_VOUCHED_MS = 650;

async function nameTube(visit, u, v, row, column, number = 1) {
  await visit.click('start', u, v);
  await visit.page.getByLabel(`Row of tube-end ${number}`).fill(String(row));
  await visit.page.getByLabel(`Column of tube-end ${number}`).fill(String(column));
}

async function openStart(browser, base, scene) {
  const visit = await Visit.open(browser, base, { scene });
  await visit.operate();
  await visit.go('Start');
  await visit.page.getByText('This picture stands still.').waitFor();
  return visit;
}

const sure = (visit) => visit.page.getByLabel('I compared a second tube-end').check();
const startButton = (visit) => visit.page.getByRole('button', { name: 'Start tracking' });

/** Checks that the panel stops vouching in time after `wish`; the page's own timers tell how busy the computer is. */
async function stopsVouching(visit, wish) {
  await visit.standing('vouched');
  await visit.page.evaluate(() => {
    const watch = { longest: 0, lag: 0, last: performance.now(), came: performance.now() };
    globalThis.watch = watch;
    globalThis.tubesight.box.addEventListener('frame', () => {
      watch.came = performance.now();
    });
    setInterval(() => {
      const now = performance.now();
      watch.lag = Math.max(watch.lag, now - watch.last - 20);
      watch.last = now;
      if (document.querySelector('.tube').dataset.standing === 'vouched') {
        watch.longest = Math.max(watch.longest, now - watch.came);
      }
    }, 20);
  });
  await wish();
  await visit.standing('unknown');
  const { longest, lag } = await visit.page.evaluate(() => globalThis.watch);
  check(longest < MOST_VOUCHED_MS + 2 * lag, `it vouched for ${longest} ms after the last picture`);
}

export const flows = {
  'start: one click, the numbers turned, three tube-ends sent': async (browser, base) => {
    const visit = await openStart(browser, base, 'waiting');
    check(await startButton(visit).isDisabled(), 'a start without a click');
    await nameTube(visit, 310, 191, 40, 60);
    await visit.page.getByText('Way 1 of 4').waitFor();
    const turn = visit.page.getByRole('button', { name: 'Turn the numbers' });
    for (const way of [2, 3, 4, 1]) {
      await turn.click();
      await visit.page.getByText(`Way ${way} of 4`).waitFor();
    }
    check(await startButton(visit).isDisabled(), 'a start with a numbering that nobody compared');
    await sure(visit);
    await turn.click();
    check(await startButton(visit).isDisabled(), 'a start with a numbering turned since');
    for (let more = 0; more < 3; more += 1) {
      await turn.click();
    }
    await sure(visit);
    await startButton(visit).click();
    await visit.standing('vouched');
    const [sent] = await visit.posted('/api/start');
    equal(sent.tubes.map((tube) => [tube.row, tube.column]), [[40, 60], [41, 60], [40, 59]], 'tube-ends of the start');
    equal(sent.confirmed, false, 'confirmed');
    check(Math.abs(sent.tubes[0].u - 310.182) < 0.001, 'the click is not on the tube-end found');
    await visit.close();
  },

  'start: refused with the click and the reason, then confirmed': async (browser, base) => {
    const visit = await openStart(browser, base, 'waiting');
    await nameTube(visit, 310, 191, 48, 60);
    await sure(visit);
    await startButton(visit).click();
    await visit.page.getByRole('alert').getByText('tube-end 1: the settings know a plug at 48 / 60').waitFor();
    equal(await visit.page.locator('.blamed').count(), 1, 'clicks blamed');
    await visit.page.getByRole('button', { name: 'Start all the same' }).click();
    await visit.page.getByRole('button', { name: 'I have checked: start' }).click();
    await visit.page.waitForURL(/#live/);
    equal((await visit.posted('/api/start')).map((sent) => sent.confirmed), [false, true, true], 'starts sent');
    await visit.close();
  },

  'start: what cannot be confirmed is not offered': async (browser, base) => {
    const visit = await openStart(browser, base, 'waiting');
    await nameTube(visit, 310, 191, 12, 60);
    await sure(visit);
    await startButton(visit).click();
    await visit.page.getByText('The start was refused').waitFor();
    check(await visit.page.getByRole('button', { name: 'Start all the same' }).isHidden(), 'it is offered');
    await visit.close();
  },

  'start: three clicks where nothing was found': async (browser, base) => {
    const visit = await openStart(browser, base, 'three');
    await visit.page.getByText('Click three tube-ends').waitFor();
    await nameTube(visit, 310, 191, 40, 60);
    check(await startButton(visit).isDisabled(), 'a start with one click');
    await nameTube(visit, 314, 247, 41, 60, 2);
    await nameTube(visit, 393, 189, 40, 61, 3);
    await startButton(visit).click();
    await visit.page.getByRole('alert').getByText('whether the numbers are turned').waitFor();
    await visit.page.getByRole('button', { name: 'Start all the same' }).click();
    await visit.page.getByRole('button', { name: 'I have checked: start' }).click();
    await visit.page.waitForURL(/#live/);
    const [sent] = await visit.posted('/api/start');
    equal(sent.tubes.map((tube) => [tube.row, tube.column]), [[40, 60], [41, 60], [40, 61]], 'tube-ends of the start');
    await visit.close();
  },

  'start: a track that stands is not replaced without a word': async (browser, base) => {
    const visit = await openStart(browser, base, 'aligned');
    await nameTube(visit, 310, 191, 40, 60);
    await sure(visit);
    await startButton(visit).click();
    await visit.page.getByRole('dialog').getByText('The box is tracking').waitFor();
    equal(await accessibility(visit.page), [], 'accessibility of the question');
    await visit.page.keyboard.press('Enter');
    await visit.page.getByRole('dialog').waitFor({ state: 'detached' });
    equal(await visit.posted('/api/start'), [], 'starts sent after Enter alone');
    await startButton(visit).click();
    await visit.page.getByRole('button', { name: 'Replace the track' }).click();
    await visit.page.waitForURL(/#live/);
    equal((await visit.posted('/api/start')).length, 2, 'starts sent, the second confirms the numbering');
    await visit.close();
  },

  'start: whoever does not operate is told so': async (browser, base) => {
    const visit = await Visit.open(browser, base, { hash: '#start' });
    await visit.page.getByText('Only the operator starts').waitFor();
    equal(await visit.posted('/api/freeze'), [], 'pictures taken');
    await visit.close();
  },

  'start: window and optimum are dragged and typed': async (browser, base) => {
    const visit = await openStart(browser, base, 'waiting');
    await visit.page.getByText('Search window and optimum').click();
    const box = await visit.page.locator('.start .picture').boundingBox();
    const scale = Math.min(box.width / 635, box.height / 480);
    const at = (u, v) => [box.x + (box.width - 635 * scale) / 2 + (u + 0.5) * scale, box.y + (v + 0.5) * scale];
    await visit.page.mouse.move(...at(40, 36));
    await visit.page.mouse.down();
    await visit.page.mouse.move(...at(80, 66), { steps: 3 });
    await visit.page.mouse.up();
    await visit.page.getByLabel('Optimum u').fill('300');
    await visit.page.getByLabel('Optimum u').press('Tab');
    await visit.page.getByRole('button', { name: 'Apply' }).click();
    await visit.page.getByText("from the box's next start on").waitFor();
    const [window] = await visit.posted('/api/window');
    check(Math.abs(window.left - 80) <= 1 && Math.abs(window.top - 66) <= 1, `dragged to ${JSON.stringify(window)}`);
    check(Math.abs(window.left + window.width - 596) <= 1, 'the right edge moved');
    equal((await visit.posted('/api/optimum'))[0].u, 300, 'optimum');
    await visit.close();
  },

  'pick: a tube clicked is named, by mouse and by touch': async (browser, base) => {
    const visit = await Visit.open(browser, base, { touch: true });
    await visit.standing('vouched');
    await visit.click('live', 393, 189);
    await visit.page.getByText('row 40, column 61').waitFor();
    await visit.click('live', 314, 247, { tap: true });
    await visit.page.getByText('row 41, column 60').waitFor();
    await visit.click('live', 310, 440);
    await visit.page.getByText('no tube-end was measured there').waitFor();
    await visit.close();
  },

  'pick: nothing is named while the tube is not known': async (browser, base) => {
    const visit = await Visit.open(browser, base, { scene: 'lost' });
    await visit.page.getByText('LOST', { exact: true }).waitFor();
    await visit.click('live', 393, 189);
    await visit.page.getByText('No tube is named while').waitFor();
    equal(await visit.posted('/api/pick'), [], 'picks sent');
    await visit.close();
  },

  'disagreement: alarm, steps, acknowledged with name and reason': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await visit.operate();
    await visit.mock({ disagreement: true });
    await visit.page.getByRole('alert').getByText('The robot says 41 / 60, the box saw 40 / 60').waitFor();
    await visit.page.getByRole('button', { name: 'Look at it' }).click();
    await visit.page.getByText('at the claim').waitFor();
    await visit.page.getByRole('button', { name: 'Earlier picture' }).click();
    await visit.page.getByText('0.03 s before').waitFor();
    await visit.page.getByRole('button', { name: 'Acknowledge' }).click();
    equal(await visit.posted('/api/acknowledge'), [], 'acknowledged without a name');
    await visit.page.getByLabel('Your name').fill('Ada');
    await visit.page.getByLabel('Reason').fill('robot was counted wrongly');
    await visit.page.getByRole('button', { name: 'Acknowledge' }).click();
    await visit.page.getByText('Acknowledged by Ada: robot was counted wrongly').waitFor();
    await visit.page.locator('#alarm').waitFor({ state: 'hidden' });
    await visit.close();
  },

  'keyboard: from the first page to a start, without a mouse': async (browser, base) => {
    const visit = await Visit.open(browser, base, { scene: 'waiting' });
    const { page } = visit;
    const tabTo = async (name) => {
      for (let count = 0; count < 40; count += 1) {
        await page.keyboard.press('Tab');
        const on = await page.evaluate(() => {
          const at = document.activeElement;
          const ring = getComputedStyle(at).outlineStyle;
          return { body: at === document.body, name: at.getAttribute('aria-label') || at.textContent || '', seen: ring !== 'none' };
        });
        if (!on.body && on.name.includes(name)) {
          check(on.seen, `the focus on '${name}' is not seen`);
          return;
        }
      }
      check(false, `Tab does not lead to '${name}'`);
    };
    await page.getByText('Operator: nobody').waitFor();
    await tabTo('Operator: nobody');
    await page.keyboard.press('Enter');
    await page.getByRole('dialog').waitFor();
    await page.keyboard.type('Ada');
    await page.keyboard.press('Enter');
    await page.getByText('You operate (Ada)').waitFor();
    await page.evaluate(() => document.activeElement.blur());
    await tabTo('Start');
    await page.keyboard.press('Enter');
    await page.getByText('tube-ends found').waitFor();
    await tabTo('Picture that stands still');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await page.getByLabel('Row of tube-end 1').waitFor();
    await page.keyboard.type('40');
    await page.keyboard.press('Tab');
    await page.keyboard.type('60');
    await tabTo('Turn the numbers');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Space');
    await tabTo('Start tracking');
    await page.keyboard.press('Enter');
    await page.waitForURL(/#live/);
    equal((await visit.posted('/api/start')).length, 2, 'starts sent, the second confirms the numbering');
    await tabTo('Camera picture');
    await visit.standing('vouched');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await page.getByText(/tube there is row/).waitFor();
    await visit.close();
  },

  'journal: told where there is one, and that it stands still': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await visit.standing('vouched');
    const chip = visit.page.locator('#health li').filter({ hasText: 'Journal' });
    check(await chip.isHidden(), 'a journal that nobody keeps is told');
    await visit.mock({ status: { journal: { state: 'writing', safe: 1234 } } });
    await visit.page.getByText('✓ Journal').waitFor();
    equal(await chip.getAttribute('title'), 'safe to row 1234', 'the last row that is safe');
    await visit.mock({ status: { journal: { state: 'standing still', safe: 1234, trouble: 'J.db: the disk is full' } } });
    await visit.page.getByText('✕ Journal: J.db: the disk is full').waitFor();
    equal(await accessibility(visit.page), [], 'accessibility');
    await visit.standing('vouched');
    await visit.close();
  },

  'frozen camera: not vouched any more, greyed, with its age': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await stopsVouching(visit, () => visit.mock({ scene: 'frozen' }));
    await visit.page.getByText(/OLD PICTURE: [1-9]\.\d s/).waitFor();
    check(await visit.page.locator('.live .picture.old').isVisible(), 'the picture is not greyed');
    await until(visit.page, () => getComputedStyle(document.querySelector('.cover')).opacity === '1');
    await visit.mock({ scene: 'aligned' });
    await visit.standing('vouched');
    equal(await visit.page.locator('.cover').evaluate((element) => Number(getComputedStyle(element).opacity)), 0, 'cover');
    await visit.close();
  },

  'dropped link: not vouched any more, said so, and back by itself': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await stopsVouching(visit, () => visit.context.setOffline(true));
    await visit.page.getByText('No connection to the box').waitFor();
    await visit.page.getByText('Box: no connection').waitFor();
    await visit.context.setOffline(false);
    await visit.standing('vouched');
    visit.trouble = visit.trouble.filter((words) => !/ERR_INTERNET_DISCONNECTED/.test(words));
    await visit.close();
  },

  'a box that answers nothing: not vouched any more': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await stopsVouching(visit, () => visit.mock({ scene: 'silent' }));
    await visit.page.getByText('No connection to the box').waitFor();
    await visit.close();
  },

  'pictures held up on the way: never vouched': async (browser, base) => {
    const visit = await Visit.open(browser, base, { scene: 'late' });
    await visit.page.evaluate(() => {
      globalThis.vouched = 0;
      setInterval(() => {
        globalThis.vouched += document.querySelector('.tube').dataset.standing === 'vouched' ? 1 : 0;
      }, 20);
    });
    await visit.page.getByText(/OLD PICTURE: [3-9]/).waitFor();
    await visit.page.waitForTimeout(500);
    equal(await visit.page.evaluate(() => globalThis.vouched), 0, 'times that it vouched');
    await visit.close();
  },

  'second operator: the first is told, and takes over only on purpose': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await visit.operate('Ada');
    await visit.mock({ operator: { held: true, mine: false, name: 'Grace' } });
    await visit.page.getByText('Grace has taken over').waitFor();
    await visit.page.getByRole('button', { name: 'Operator: Grace' }).click();
    await visit.page.getByRole('dialog').getByText('Grace operates now').waitFor();
    equal(await accessibility(visit.page), [], 'accessibility of the question');
    await visit.page.getByRole('dialog').getByLabel('Your name').fill('Ada');
    await visit.page.getByRole('button', { name: 'Take over' }).click();
    await visit.page.getByText('You operate (Ada)').waitFor();
    equal(await visit.posted('/api/operator'), [{ take: true, name: 'Ada', confirmed: true }], 'what was sent');
    await visit.close();
  },

  'session: ends, nothing is vouched, back with the password': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    await stopsVouching(visit, () => visit.mock({ scene: 'locked' }));
    await visit.page.getByRole('dialog').getByText('Log in to this box').waitFor();
    equal(await accessibility(visit.page), [], 'accessibility of the login');
    await visit.page.getByLabel('Password').fill('guess');
    await visit.page.getByRole('button', { name: 'Log in' }).click();
    await visit.page.getByText('That password is not right. Try again in 1 s.').waitFor();
    await visit.page.getByLabel('As', { exact: true }).selectOption('operator');
    await visit.page.getByLabel('Password').fill('plant');
    await visit.page.getByRole('button', { name: 'Log in' }).click();
    await visit.standing('vouched');
    await visit.close();
  },

  'sheet: 11,000 tubes move and zoom within a picture\'s time': async (browser, base) => {
    const visit = await Visit.open(browser, base, { hash: '#sheet' });
    await visit.page.locator('.legend .count', { hasText: '11216' }).waitFor();
    const times = await visit.page.evaluate(async () => {
      const { map } = globalThis.tubesight.screens.sheet[1];
      const frame = () => new Promise((done) => requestAnimationFrame(done));
      map.drawMs.length = 0;
      for (let k = 0; k < 60; k += 1) {
        map.zoom(k < 30 ? 1.08 : 1 / 1.05);
        map.pan(3 * Math.sin(k / 9), 2);
        await frame();
      }
      return [...map.drawMs].sort((a, b) => a - b);
    });
    check(times.length >= 50, `only ${times.length} pictures were drawn`);
    const median = times[times.length >> 1];
    console.log(`        sheet: median ${median.toFixed(1)} ms, worst ${times[times.length - 1].toFixed(1)} ms a picture`);
    check(median < 8, `a picture takes ${median} ms`);
    await visit.close();
  },

  'sheet: searched, clicked, exported': async (browser, base) => {
    const visit = await Visit.open(browser, base, { hash: '#sheet' });
    const { page } = visit;
    await page.locator('.legend .count', { hasText: '11216' }).waitFor();
    await page.locator('.search').getByLabel('Row').fill('39');
    await page.locator('.search').getByLabel('Column').fill('58');
    await page.keyboard.press('Enter');
    await page.getByText('Row 39, column 58: contradicted, 1 time.').waitFor();
    const box = await page.locator('.sheet-map').boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await page.getByText('Row 39, column 58').waitFor();
    await page.locator('.search').getByLabel('Row').fill('99');
    await page.keyboard.press('Enter');
    await page.getByText('There is no tube 99 / 58').waitFor();
    const got = {};
    for (const kind of ['SVG', 'PNG', 'CSV']) {
      const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: kind }).click()]);
      got[kind] = fs.readFileSync(await download.path());
    }
    const rows = got.CSV.toString().trim().split('\n');
    equal(rows.length, 1 + 11216 + 21 + 4 + 16 + 8 + 1, 'rows of the CSV file');
    check(rows.includes('39,58,1473.2000,990.6000,open,contradicted,1,95.000000'), 'the contradicted tube in the CSV file');
    equal([...got.PNG.subarray(1, 4)].map((code) => String.fromCharCode(code)).join(''), 'PNG', 'the PNG file');
    const titles = await page.evaluate((text) => {
      const parsed = new DOMParser().parseFromString(text, 'image/svg+xml');
      return parsed.querySelector('parsererror') ? -1 : parsed.querySelectorAll('g > title').length;
    }, got.SVG.toString());
    equal(titles, rows.length - 1, 'tubes in the SVG file');
    await visit.close();
  },

  'trouble-shooting: lamp, recording, estimates': async (browser, base) => {
    const visit = await Visit.open(browser, base, { hash: '#trouble' });
    await visit.operate();
    await visit.page.getByText('62 %').waitFor();
    await visit.page.getByLabel('Lamp', { exact: true }).focus();
    await visit.page.keyboard.press('ArrowRight');
    await visit.page.getByText('63 %, by hand').waitFor();
    await visit.page.getByRole('button', { name: 'Automatic' }).click();
    await visit.page.getByText('62 %, automatic').waitFor();
    equal(await visit.posted('/api/lamp'), [{ permille: 630 }, { automatic: true }], 'lamp commands');
    await visit.page.getByRole('button', { name: 'Record now' }).click();
    await visit.page.getByText('Recorded: asked-0005').waitFor();
    await visit.page.getByRole('row', { name: 'latency median us 812' }).waitFor();
    await visit.close();
  },

  'settings: checked, saved, restored; a viewer only looks': async (browser, base) => {
    const visit = await Visit.open(browser, base, { hash: '#settings' });
    const { page } = visit;
    const text = page.getByLabel('Settings of the box');
    await until(page, () => document.querySelector('textarea').value.includes('[source]'));
    await text.fill('colour = "blue"');
    await page.getByRole('button', { name: 'Save' }).click();
    await page.getByText("box.toml:3: unknown key 'colour'").waitFor();
    check(await page.getByRole('dialog').count() === 0, 'bad settings are about to be saved');
    await page.getByLabel('Settings to restore').setInputFiles({ name: 'old.toml', mimeType: 'text/plain', buffer: Buffer.from('format = 1\n') });
    await page.getByText('Nothing is wrong with these settings').waitFor();
    await page.getByRole('button', { name: 'Save' }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'Save' }).click();
    await page.getByText('The old settings are in box.toml.1').waitFor();
    equal((await visit.posted('/api/settings')).pop(), { text: 'format = 1\n' }, 'what was saved');
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Back up' }).click()]);
    equal(download.suggestedFilename(), 'tubesight-settings.toml', 'the backup');
    await visit.mock({ role: 'viewer' });
    await page.reload({ waitUntil: 'domcontentloaded' });
    await until(page, () => document.querySelector('textarea').value.includes('[source]'));
    check(await page.getByRole('button', { name: 'Save' }).isDisabled(), 'a viewer may save');
    check(!(await text.isEditable()), 'a viewer may write');
    await visit.close();
  },

  'names and reasons are shown as they are written, and never run': async (browser, base) => {
    const visit = await Visit.open(browser, base);
    const { page } = visit;
    const evil = '<img src=x onerror="globalThis.ran=1"><b>Eve</b>';
    await visit.mock({ operator: { held: true, mine: false, name: evil } });
    await page.getByRole('button', { name: 'Operator: <img' }).waitFor();
    await visit.operate('Ada');
    await visit.mock({ disagreement: true });
    await page.getByRole('button', { name: 'Look at it' }).click();
    await page.getByText('at the claim').waitFor();
    await page.getByLabel('Your name').fill(evil);
    await page.getByLabel('Reason').fill(evil);
    await page.getByRole('button', { name: 'Acknowledge' }).click();
    await page.getByText(`Acknowledged by ${evil}: ${evil}`).waitFor();
    await visit.mock({ replies: { '/api/settings/check': [200, { messages: [`box.toml:1: ${evil}`] }] } });
    await visit.go('Settings');
    await until(page, () => document.querySelector('textarea').value.includes('[source]'));
    await page.getByLabel('Settings of the box').fill(evil);
    await page.getByRole('button', { name: 'Save' }).click();
    await page.getByText(`box.toml:1: ${evil}`).waitFor();
    const found = await page.evaluate(() => [globalThis.ran === undefined, document.querySelectorAll('img, b').length]);
    equal(found, [true, 0], 'nothing ran, nothing became an element');
    await visit.close();
  },
};
