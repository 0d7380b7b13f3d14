// Puts the screens together: which one is shown, health, operator, alarms, login.
import { Box } from './box.js';
import { ask } from './dialog.js';
import { button, make, tell } from './dom.js';
import { DisagreementScreen } from './disagreement.js';
import { LiveScreen } from './live.js';
import { SettingsScreen } from './settings.js';
import { SheetScreen } from './sheet.js';
import { StartScreen } from './start.js';
import { TroubleScreen } from './trouble.js';

const TICK_MS = 100;
const NOTICE_MS = 7000;

const byId = (id) => document.getElementById(id);
const box = new Box();
const shown = { name: null };

function notify(text, kind = '') {
  const notice = make('p', { class: `notice ${kind}` }, text);
  byId('notices').append(notice);
  setTimeout(() => notice.remove(), NOTICE_MS);
  while (byId('notices').children.length > 3) {
    byId('notices').firstChild.remove();
  }
}

const screens = {
  live: ['Live', new LiveScreen(box, notify)],
  start: ['Start', new StartScreen(box, notify, go)],
  disagreement: ['Disagreement', new DisagreementScreen(box, notify, refreshDisagreements)],
  sheet: ['Sheet', new SheetScreen(box, notify)],
  trouble: ['Trouble', new TroubleScreen(box, notify)],
  settings: ['Settings', new SettingsScreen(box, notify)],
};
const buttons = Object.fromEntries(
  Object.entries(screens).map(([name, [title]]) => [name, button(title, () => go(name))]),
);

function current() {
  return screens[shown.name][1];
}

function go(name) {
  if (window.location.hash !== `#${name}`) {
    window.location.hash = name;
  } else {
    show(name);
  }
}

function show(name) {
  if (name === shown.name) {
    return;
  }
  const before = shown.name ? current() : null;
  shown.name = name;
  for (const [each, [, screen]] of Object.entries(screens)) {
    screen.element.hidden = each !== name;
    if (each === name) {
      buttons[each].setAttribute('aria-current', 'page');
    } else {
      buttons[each].removeAttribute('aria-current');
    }
  }
  box.estimates = name === 'trouble';
  document.title = `${screens[name][0]} – Tubesight`;
  if (before && before.hidden) {
    before.hidden();
  }
  if (box.last && current().camera) {
    current().camera(box.last);
  }
  if (current().shown && box.sessionState === 'open') {
    current().shown();
  }
}

function showFromAddress() {
  const name = window.location.hash.slice(1);
  show(screens[name] ? name : 'live');
}

// Health: what the picture hangs on, in words.

const chips = Object.fromEntries(
  ['Box', 'Camera', 'Lamp', 'Robot', 'Journal'].map((name) => [name, make('li', {})]),
);

function chip(name, good, words) {
  const element = chips[name];
  element.className = good === null ? 'unknown' : good ? 'good' : 'bad';
  tell(
    element,
    `${good === null ? '?' : good ? '✓' : '✕'} ${name}${words && good === false ? `: ${words}` : ''}`,
  );
  element.title = words || '';
}

const isWell = (words) =>
  !words || /^(well|good|ok|open|up|playing|automatic|connected)\b/i.test(words);

function showHealth() {
  const up = box.link === 'up';
  chip('Box', box.sessionState === 'unknown' ? null : up, up ? '' : 'no connection');
  const sighting = up && box.last ? box.last.sighting : null;
  const old = !(box.pictureAge() <= 0.5);
  const camera = sighting && sighting.camera;
  chip(
    'Camera',
    !sighting ? null : isWell(camera && camera.words) && !old,
    old && isWell(camera && camera.words) ? 'no new picture' : camera && camera.words,
  );
  const lamp = sighting && sighting.lamp;
  chip('Lamp', !lamp ? null : isWell(lamp.words), lamp && lamp.words);
  const link = sighting && sighting.link;
  chip(
    'Robot',
    !link || link.state === 'none'
      ? null
      : link.state !== 'down' && isWell(link.words || link.state),
    link && (link.state === 'none' ? 'not connected' : link.words || link.state),
  );
  const journal = up && box.status ? box.status.journal : null;
  chips.Journal.hidden = !journal || journal.state === 'none';
  if (!chips.Journal.hidden) {
    const writes = journal.state === 'writing';
    chip('Journal', writes, writes ? `safe to row ${journal.safe}` : journal.trouble || journal.state);
  }
}

// The operator.

function showOperator() {
  const { session } = box;
  const operator = session && session.operator;
  const role = session ? session.role : 'none';
  const text =
    !operator || box.sessionState !== 'open'
      ? 'Operator: not known'
      : operator.mine
        ? `You operate${operator.name ? ` (${operator.name})` : ''}`
        : operator.held
          ? `Operator: ${operator.name || 'somebody'}`
          : 'Operator: nobody';
  tell(byId('operator'), text);
  byId('operator').dataset.mine = operator && operator.mine ? 'true' : 'false';
  byId('operator').disabled = role === 'viewer' || role === 'none' || box.sessionState !== 'open';
}

async function changeOperator() {
  const operator = (box.session && box.session.operator) || {};
  if (operator.mine) {
    if (
      await ask({
        title: 'Stop operating?',
        text: 'Somebody else can then operate. You go on watching.',
        accept: 'Stop operating',
      })
    ) {
      await box.post('/api/operator', { take: false });
    }
  } else {
    const answer = await ask({
      title: operator.held ? `${operator.name || 'Somebody'} operates now` : 'Operate the box',
      grave: Boolean(operator.held),
      text: operator.held
        ? 'Talk to them first. They are told that you took over.'
        : 'One person at a time starts, acknowledges and sets the lamp.',
      fields: { name: { label: 'Your name', required: true, autocomplete: 'name' } },
      accept: operator.held ? 'Take over' : 'Operate',
    });
    if (!answer || !answer.name) {
      return;
    }
    const taken = await box.post('/api/operator', {
      take: true,
      name: answer.name,
      confirmed: Boolean(operator.held),
    });
    if (!taken.good) {
      notify(taken.words, 'bad');
    }
  }
  await box.refresh();
  if (shown.name === 'start' && box.operating) {
    current().shown();
  }
}

// Alarms.

function alarm(text, target) {
  const element = byId('alarm');
  element.hidden = !text;
  element.replaceChildren(
    ...(text ? [make('span', {}, text), button('Look at it', () => go(target))] : []),
  );
}

async function refreshDisagreements() {
  const screen = screens.disagreement[1];
  const open = await screen.refresh();
  buttons.disagreement.textContent = open ? `Disagreement (${open})` : 'Disagreement';
  buttons.disagreement.classList.toggle('alert', open > 0);
  const first = screen.open[0];
  alarm(
    first
      ? `The robot says ${first.claim.row} / ${first.claim.column}, the box saw ${
          first.tube && Number.isInteger(first.tube.row)
            ? `${first.tube.row} / ${first.tube.column}`
            : 'another tube'
        }.`
      : '',
    'disagreement',
  );
}

// The session.

let asking = false;

async function login() {
  if (asking) {
    return;
  }
  asking = true;
  let problem = '';
  while (box.sessionState === 'login') {
    const answer = await ask({
      title: 'Log in to this box',
      cancel: null,
      accept: 'Log in',
      problem,
      fields: {
        role: { label: 'As', options: ['viewer', 'operator', 'engineer'] },
        password: {
          label: 'Password',
          type: 'password',
          required: true,
          autocomplete: 'current-password',
        },
      },
    });
    const reply = await box.post('/api/login', answer);
    if (reply.good) {
      box.take(reply.data);
      await refreshDisagreements();
      if (current().shown) {
        current().shown();
      }
    } else {
      const wait = reply.data.retry_after_s;
      problem = `${reply.words}${wait ? ` Try again in ${Math.ceil(wait)} s.` : ''}`;
    }
  }
  asking = false;
}

box.addEventListener('session', () => {
  showOperator();
  screens.settings[1].session();
  if (box.sessionState === 'login') {
    login();
  }
});
box.addEventListener('frame', ({ detail }) => {
  if (current().camera) {
    current().camera(detail);
  }
});
box.addEventListener('status', ({ detail }) => screens.trouble[1].status(detail));
box.addEventListener('operator', ({ detail }) => {
  if (!detail.mine && byId('operator').dataset.mine === 'true' && detail.held) {
    notify(`${detail.name || 'Somebody'} has taken over. You watch now.`, 'bad');
  }
  showOperator();
});
box.addEventListener('disagreement', refreshDisagreements);
box.addEventListener('log', ({ detail }) =>
  notify(detail.text, detail.level === 'error' ? 'bad' : ''),
);

byId('screens').append(...Object.values(buttons));
byId('health').append(...Object.values(chips));
byId('operator').addEventListener('click', changeOperator);
byId('main').append(...Object.values(screens).map(([, screen]) => screen.element));
window.addEventListener('hashchange', showFromAddress);
showFromAddress();
setInterval(() => {
  if (current().tick) {
    current().tick();
  }
  showHealth();
}, TICK_MS);
showHealth();
box.start().then(() => {
  if (box.sessionState === 'open') {
    refreshDisagreements();
    if (current().shown) {
      current().shown();
    }
  }
});
// For the tests, and for whoever looks at the page with a browser's tools.
window.tubesight = { box, screens };
