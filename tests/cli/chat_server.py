"""A server with /v1/chat/completions on this machine, as a fixture."""
import http.server
import json
import threading
import time

import pytest


class Server(http.server.BaseHTTPRequestHandler):
    """Streams a text, or refuses and repeats the key that it was sent, or says nothing until it is let go."""

    def do_POST(self):
        asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.server.asked.append(asked)
        if self.server.silent:
            self.server.let_go.wait()
            return
        time.sleep(self.server.pause)
        refuses = self.server.refuses or (self.server.refuses_after is not None and len(self.server.asked) > self.server.refuses_after)
        self.send_response(401 if refuses else 200)
        self.end_headers()
        if refuses:
            self.wfile.write((self.headers["Authorization"] or "no key").encode())
            return
        for text in ("Scenario Analysis\n1. Grip is 0.90.\n", self.server.conclusion):
            self.wfile.write(b"data: " + json.dumps({"choices": [{"delta": {"content": text}}]}).encode() + b"\n\n")
        self.wfile.write(b'data: {"choices": [{"delta": {}, "finish_reason": "stop"}]}\n\ndata: [DONE]\n\n')

    def log_message(self, *_):
        pass


@pytest.fixture
def server():
    found = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
    found.asked, found.refuses, found.conclusion = [], False, "Response to user: 6"
    found.refuses_after = None  # so many questions
    found.silent, found.let_go = False, threading.Event()
    found.pause = 0.0  # [s] before each reply
    threading.Thread(target=found.serve_forever, daemon=True).start()
    yield found
    found.let_go.set()
    found.shutdown()
