// Settings: seen by all, changed by the engineer, with the same checks and words as `tubesightd
// --check`.
import { ask } from './dialog.js';
import { button, labelled, make, save, tell } from './dom.js';
import { flattened } from './trouble.js';

export class SettingsScreen {
  constructor(box, notify) {
    this.box = box;
    this.notify = notify;
    this.saved = '';
    const text = labelled(
      'Settings of the box',
      { class: 'code', spellcheck: 'false', autocapitalize: 'off' },
      'textarea',
    );
    this.text = text.input;
    this.path = make('p', { class: 'step-words' });
    this.messages = make('ul', { class: 'messages' });
    this.keep = button('Save', () => this.put(), { class: 'main' });
    this.file = make('input', {
      type: 'file',
      accept: '.toml',
      'aria-label': 'Settings to restore',
      class: 'unseen',
      tabindex: '-1',
    });
    this.file.addEventListener('change', () => this.restore());
    this.versions = make('dl', { class: 'facts' });
    this.tests = make('ul', { class: 'messages' });
    text.row.classList.add('editor');
    this.element = make(
      'section',
      { class: 'settings screen', 'aria-label': 'Settings' },
      make(
        'div',
        { class: 'detail' },
        this.path,
        text.row,
        make('div', { role: 'status', 'aria-label': 'What the check says' }, this.messages),
        make(
          'div',
          { class: 'buttons' },
          button('Check', () => this.check()),
          this.keep,
          button('Back up', () => this.backUp()),
          button('Restore …', () => this.file.click()),
          this.file,
        ),
      ),
      make(
        'section',
        { class: 'side', 'aria-label': 'Version and self-test' },
        make('h2', {}, 'This box'),
        this.versions,
        make('h3', {}, 'Self-test'),
        make(
          'div',
          { class: 'buttons' },
          button('Run the self-test', () => this.selfTest()),
        ),
        this.tests,
      ),
    );
  }

  async shown() {
    this.session();
    if (this.text.value !== this.saved) {
      return; // Somebody is at work on it.
    }
    const answer = await this.box.get('/api/settings');
    if (answer.good) {
      this.saved = answer.data.text || '';
      this.text.value = this.saved;
      tell(this.path, answer.data.path || '');
    } else {
      tell(this.path, answer.words);
    }
  }

  session() {
    const { session } = this.box;
    const engineer = Boolean(session && session.role === 'engineer');
    this.text.readOnly = !engineer;
    this.keep.disabled = !engineer;
    this.keep.title = engineer ? '' : 'Only an engineer changes settings.';
    this.versions.replaceChildren(
      ...flattened(session && session.box).map(([name, value]) =>
        make('div', {}, make('dt', {}, name), make('dd', {}, String(value))),
      ),
    );
  }

  tellMessages(messages, none) {
    this.messages.replaceChildren(
      ...(messages.length ? messages : [none]).map((message) =>
        make(
          'li',
          { class: messages.length ? 'bad' : 'good' },
          typeof message === 'string' ? message : message.text || JSON.stringify(message),
        ),
      ),
    );
  }

  async check() {
    const answer = await this.box.post('/api/settings/check', { text: this.text.value });
    this.tellMessages(
      answer.good ? answer.data.messages || [] : [answer.words],
      'Nothing is wrong with these settings.',
    );
    return answer.good && !(answer.data.messages || []).length;
  }

  async put() {
    if (
      !(await this.check()) ||
      !(await ask({
        title: 'Save these settings?',
        accept: 'Save',
        text: 'The box keeps the old ones beside them. They hold from its next start on.',
      }))
    ) {
      return;
    }
    const answer = await this.box.request('PUT', '/api/settings', { text: this.text.value });
    const messages = (answer.data && answer.data.messages) || [];
    this.tellMessages(
      answer.good ? messages : messages.length ? messages : [answer.words],
      'Saved.',
    );
    if (answer.good && answer.data.saved !== false) {
      this.saved = this.text.value;
      this.notify(
        `Saved.${answer.data.backup ? ` The old settings are in ${answer.data.backup}.` : ''}`,
      );
    }
  }

  async backUp() {
    const answer = await fetch('/api/backup', { credentials: 'same-origin' }).catch(() => null);
    if (answer && answer.ok) {
      const tar = (answer.headers.get('Content-Type') || '').includes('tar');
      save(tar ? 'tubesight-backup.tar' : 'tubesight-settings.toml', '', await answer.blob());
    } else {
      this.notify('The box gave no backup.', 'bad');
    }
  }

  async restore() {
    const [file] = this.file.files;
    if (file) {
      this.text.value = await file.text();
      this.file.value = '';
      this.notify('The file stands in the editor. Check it, then save it.');
      await this.check();
    }
  }

  async selfTest() {
    this.tests.replaceChildren(make('li', {}, 'Running …'));
    const answer = await this.box.post('/api/self-test');
    const parts = answer.good
      ? answer.data.parts || []
      : [{ name: 'self-test', verdict: 'failed', words: answer.words }];
    this.tests.replaceChildren(
      ...parts.map((part) =>
        make(
          'li',
          { class: /^(good|passed|ok)$/.test(part.verdict) ? 'good' : 'bad' },
          `${part.name}: ${part.verdict}${part.words ? `. ${part.words}` : ''}`,
        ),
      ),
    );
  }
}
