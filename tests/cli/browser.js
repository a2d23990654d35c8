// Opens a page in headless Chromium over its pipe (requires only Node.js), runs a script in it and prints the script's result
// as JSON, with every error of the console and every request that left the page:
//
//   node browser.js CHROMIUM PAGE.html[#link] SCRIPT [--size WIDTHxHEIGHT] [--shot FILE.png] [--pdf FILE.pdf] [--dark]
//
// SCRIPT is the body of an async function; press(x, y) clicks at a position [px], key(name) presses a key, and sleep(ms)
// waits.
const {spawn} = require('child_process'), fs = require('fs'), os = require('os'), path = require('path');
const [chromium, page, script, ...rest] = process.argv.slice(2);
const option = name => rest.includes(name) ? rest[rest.indexOf(name) + 1] : '';
const [width, height] = (option('--size') || '1280x900').split('x').map(Number);
const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'dresslife-browser-'));
const browser = spawn(
    chromium,
    [
      '--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-sandbox',
      '--disable-dev-shm-usage', '--no-first-run', '--disable-background-networking', '--remote-debugging-pipe',
      `--user-data-dir=${profile}`, `--window-size=${width},${height}`, 'about:blank'
    ],
    {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true});  // its own process group
const end = () => process.kill(-browser.pid, 'SIGKILL');

const waiting = new Map(), problems = [], requests = [];
let count = 0, unread = '', session = '';
browser.stdio[4].on('data', text => {
  unread += text;
  for (let end; (end = unread.indexOf('\0')) >= 0; unread = unread.slice(end + 1)) receive(JSON.parse(unread.slice(0, end)));
});
function receive(message) {
  if (message.id) {
    const {resolve, reject} = waiting.get(message.id);
    message.error ? reject(new Error(JSON.stringify(message.error))) : resolve(message.result);
    return;
  }
  if (message.method === 'Runtime.exceptionThrown')
    problems.push(message.params.exceptionDetails.exception?.description || message.params.exceptionDetails.text);
  if (message.method === 'Runtime.consoleAPICalled' && ['error', 'warning'].includes(message.params.type))
    problems.push(message.params.args.map(a => a.value || a.description).join(' '));
  if (message.method === 'Log.entryAdded' && message.params.entry.level === 'error') problems.push(message.params.entry.text);
  if (message.method === 'Network.requestWillBeSent' && !/^(data|blob):/.test(message.params.request.url))
    requests.push(message.params.request.url);
}
const send = (method, params = {}) => new Promise((resolve, reject) => {
  waiting.set(++count, {resolve, reject});
  browser.stdio[3].write(JSON.stringify({id: count, method, params, ...(session && {sessionId: session})}) + '\0');
});
const sleep = ms => new Promise(resolve => setTimeout(resolve, ms));
async function evaluate(expression) {
  const {result, exceptionDetails} = await send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
  if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
  return result.value;
}
async function press(x, y) {
  for (const type of ['mousePressed', 'mouseReleased'])
    await send('Input.dispatchMouseEvent', {type, x, y, button: 'left', buttons: 1, clickCount: 1, pointerType: 'mouse'});
  await sleep(150);
}
async function key(name) {
  for (const type of ['keyDown', 'keyUp'])
    await send('Input.dispatchKeyEvent', {type, key: name, text: type === 'keyDown' && name.length === 1 ? name : undefined});
  await sleep(150);
}

async function main() {
  const {targetId} = await send('Target.createTarget', {url: 'about:blank'});
  session = (await send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await send(domain + '.enable');
  if (rest.includes('--dark'))
    await send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value: 'dark'}]});
  await send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: false});
  await send('Page.navigate', {url: 'file://' + page});
  const ready = `document.readyState === 'complete' && (!document.getElementById('data') || document.body.dataset.ready)`;
  for (let k = 0; k < 300 && !(await evaluate(ready).catch(() => '')); ++k)
    await sleep(100);
  const AsyncFunction = main.constructor;
  const result = await new AsyncFunction('evaluate', 'press', 'key', 'sleep', 'send', script)(evaluate, press, key, sleep, send);
  await sleep(300);
  if (option('--shot'))
    fs.writeFileSync(option('--shot'), Buffer.from((await send('Page.captureScreenshot', {format: 'png'})).data, 'base64'));
  if (option('--pdf'))
    fs.writeFileSync(option('--pdf'), Buffer.from((await send('Page.printToPDF', {printBackground: true})).data, 'base64'));
  console.log(JSON.stringify({result: result === undefined ? null : result, problems, requests}));
}
const watchdog = setTimeout(() => {
  console.error('the browser does not answer');
  end();
  process.exit(1);
}, 120000);
main()
    .catch(problem => {
      console.error(problem.stack);
      process.exitCode = 1;
    })
    .finally(() => {
      clearTimeout(watchdog);
      browser.on('exit', () => {
        try {  // an ending process of the group may still write into the profile
          fs.rmSync(profile, {recursive: true, force: true, maxRetries: 20, retryDelay: 100});
        } catch (problem) {
          console.error(`${profile} could not be removed: ${problem.message}`);
        }
      });
      end();
    });
