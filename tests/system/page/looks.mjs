// What each screen looks like at three sizes, and what an accessibility checker says of it.
import { accessibility, check, equal, Visit } from './harness.mjs';
import { compare, differing, kept } from './golden.mjs';

const SIZES = [[1024, 768], [1280, 800], [1920, 1080]];
const MASKED = ['.facts div:has(dt:text-is("Age")) dd', '.picture .age'];

const screens = {
  live: { standing: 'vouched' },
  start: {
    prepare: async (visit) => {
      await visit.go('Start');
      await visit.page.getByText('tube-ends found').waitFor();
      await visit.click('start', 310, 191);
      await visit.page.getByLabel('Row of tube-end 1').fill('40');
      await visit.page.getByLabel('Column of tube-end 1').fill('60');
    },
  },
  disagreement: {
    prepare: async (visit) => {
      await visit.mock({ disagreement: true });
      await visit.page.getByRole('button', { name: 'Look at it' }).click();
      await visit.page.getByText('at the claim').waitFor();
    },
  },
  sheet: {
    prepare: async (visit) => {
      await visit.go('Sheet');
      await visit.page.locator('.legend .count', { hasText: '11216' }).waitFor();
    },
  },
  trouble: {
    prepare: async (visit) => {
      await visit.go('Trouble');
      await visit.page.getByText('lost-0003').waitFor();
      await visit.page.getByText('Dark (below').waitFor();
    },
  },
  settings: {
    prepare: async (visit) => {
      await visit.go('Settings');
      await visit.page.getByRole('button', { name: 'Run the self-test' }).click();
      await visit.page.getByText('golden recording: good').waitFor();
    },
  },
};

/** All that a screen shows lies within the window, and the page itself does not scroll. */
async function fits(page) {
  const over = await page.evaluate(() => {
    const root = document.scrollingElement;
    const out = [...document.querySelectorAll('button, input, .tube, .message')].filter((element) => {
      const box = element.getBoundingClientRect();
      return box.width > 1 && (box.left < -1 || box.right > window.innerWidth + 1);
    });
    return { scrolls: root.scrollWidth > window.innerWidth || root.scrollHeight > window.innerHeight, out: out.length };
  });
  equal(over, { scrolls: false, out: 0 }, 'what does not fit the window');
}

/** The digits of the tube are at least 15 mm high on a screen of 96 dpi: 25 minutes of arc from 2 m. */
async function readable(page) {
  const size = await page.locator('.live .number').first().evaluate((element) => parseFloat(getComputedStyle(element).fontSize));
  check(size * 0.73 >= 56, `the tube's digits are only ${size} px`);
}

async function settle(visit) {
  await visit.page.mouse.move(1, 1);
  await visit.page.waitForTimeout(350);
}

export const looks = {};
for (const [name, { standing, prepare }] of Object.entries(screens)) {
  for (const [width, height] of SIZES) {
    looks[`looks: ${name} at ${width}x${height}`] = async (browser, base) => {
      const visit = await Visit.open(browser, base, { width, height });
      await visit.operate();
      await visit.standing('vouched');
      if (prepare) {
        await prepare(visit);
      } else {
        check(standing === 'vouched', 'nothing to wait for');
        await readable(visit.page);
      }
      await settle(visit);
      await fits(visit.page);
      if (!prepare) {
        await visit.standing('vouched');
      }
      await compare(visit.page, `${name}-${width}`, MASKED);
      if (width === 1024) {
        equal(await accessibility(visit.page), [], `accessibility of ${name}`);
      }
      await visit.close();
    };
  }
}

const states = { between: 'seen', contradicted: 'vouched', lost: 'unknown', degraded: 'seen', void: 'none', waiting: 'unknown', frozen: 'unknown' };
for (const [scene, standing] of Object.entries(states)) {
  looks[`looks: live, ${scene}`] = async (browser, base) => {
    const visit = await Visit.open(browser, base, { scene });
    await visit.operate();
    await visit.standing(standing);
    if (scene === 'frozen') {
      await visit.page.getByText('OLD PICTURE').waitFor();
      await visit.page.waitForTimeout(1300);
    }
    await settle(visit);
    await visit.standing(standing);
    await compare(visit.page, `live-${scene}`, MASKED);
    equal(await accessibility(visit.page), [], `accessibility, ${scene}`);
    await visit.close();
  };
}

looks['looks: a start refused'] = async (browser, base) => {
  const visit = await Visit.open(browser, base, { scene: 'waiting' });
  await visit.operate();
  await visit.go('Start');
  await visit.page.getByText('tube-ends found').waitFor();
  await visit.click('start', 310, 191);
  await visit.page.getByLabel('Row of tube-end 1').fill('48');
  await visit.page.getByLabel('Column of tube-end 1').fill('60');
  await visit.page.getByLabel('I compared a second tube-end').check();
  await visit.page.getByRole('button', { name: 'Start tracking' }).click();
  await visit.page.getByText('The start was refused').waitFor();
  await settle(visit);
  await compare(visit.page, 'start-refused');
  equal(await accessibility(visit.page), [], 'accessibility of a refused start');
  await visit.close();
};

looks['looks: a kept picture of another state is told apart'] = async () => {
  if (process.argv.includes('--update')) {
    return;
  }
  const share = differing(kept('live-1024'), kept('live-between'));
  check(share > 0.006, `vouched and not vouched look alike: only ${share} differs`);
  equal(differing(kept('live-1024'), kept('live-1024')), 0, 'the same picture');
};
