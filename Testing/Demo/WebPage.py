# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/web_page.py in a browser: the page shows the jet, and dragging it turns it. Skipped without Debian's chromium, and
without trame in a virtual environment that PV_VENV names."""

import asyncio
import base64
import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile

import numpy as np
from demo_testing import PVPYTHON, SOURCE, image_array

venv = os.environ.get("PV_VENV")
if not venv or not shutil.which("chromium"):
    print("Not here: chromium, or PV_VENV with trame.")
    sys.exit(77)
from paraview.web import venv as _  # noqa: E402, F401, which adds PV_VENV to the path

import aiohttp  # noqa: E402, which trame brings along


@contextlib.contextmanager
def started(*command):
    process = subprocess.Popen(command, start_new_session=True)
    try:
        yield
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


async def answer(get, seconds=100):
    """What get() gives as soon as it gives something."""
    for _ in range(2 * seconds):
        with contextlib.suppress(aiohttp.ClientError, StopIteration):
            if result := await get():
                return result
        await asyncio.sleep(0.5)
    raise TimeoutError(get)


async def look():
    async with aiohttp.ClientSession() as session:
        async def served():
            async with session.get("http://localhost:8571/") as page:
                return page.status == 200

        async def tab():
            async with session.get("http://localhost:8572/json") as tabs:
                return next(tab for tab in await tabs.json() if tab["type"] == "page")["webSocketDebuggerUrl"]

        await answer(served)
        async with session.ws_connect(await answer(tab), max_msg_size=0) as browser:
            async def call(method, **parameters):
                await browser.send_json({"id": 1, "method": method, "params": parameters})
                while (message := await browser.receive_json()).get("id") != 1:
                    pass
                return message.get("result", {})

            async def drawn():
                """The image below the toolbar in a tuple; None before it is drawn."""
                if not (data := (await call("Page.captureScreenshot")).get("data")):
                    return None
                with open("page.png", "wb") as file:
                    file.write(base64.b64decode(data))
                image = image_array("page.png")[100:-50]
                return (image,) if image.std() > 15 else None

            async def mouse(kind, x, y):
                await call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)

            await call("Page.navigate", url="http://localhost:8571/")
            before, = await answer(drawn)
            await mouse("mousePressed", 500, 350)
            for step in range(1, 11):
                await mouse("mouseMoved", 500 + 12 * step, 350 + 8 * step)
                await asyncio.sleep(0.2)
            await mouse("mouseReleased", 620, 430)

            async def turned():
                image = await drawn()
                return image and np.abs(image[0] - before).mean() > 3

            await answer(turned)
            print("The page's grey levels", before.min(), before.max(), before.std())


with tempfile.TemporaryDirectory() as profile:
    with started(PVPYTHON, os.path.join(SOURCE, "Examples", "web_page.py"), "--venv", venv, "--server", "--port", "8571"), \
         started("chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--log-level=3", "--window-size=1000,700",
                 "--remote-debugging-port=8572", f"--user-data-dir={profile}", "about:blank"):
        asyncio.run(look())
