"""What is rare on a bus, over Zenoh: questions and their answers, and who is alive. All of it waits in mailboxes."""

from typing import Any

import zenoh

from schemas.bus.contract import Answer, NoAnswerError, Presence, PresenceWatch, Question, Server
from schemas.bus.mailbox import EveryMailbox
from schemas.bus.session import Seat
from schemas.message import Message
from schemas.topic import Topic
from schemas.topics import TOPICS


class ZenohQuestion(Question):
    def __init__(self, topic: Topic, query: zenoh.Query) -> None:
        super().__init__(topic, topic.key, query.payload.to_bytes() if query.payload is not None else b"")
        self._query = query

    def answer(self, reply: Message) -> None:
        with self._query as query:
            query.reply(query.key_expr, reply.encode(), encoding=zenoh.Encoding.APPLICATION_JSON)

    def fail(self, reason: str) -> None:
        with self._query as query:
            query.reply_err(reason)


class ZenohServer(Server):
    def __init__(self, topic: Topic, key: str, seat: Seat) -> None:
        self.mailbox: EveryMailbox[Question] = EveryMailbox()

        def bring(query: zenoh.Query) -> None:
            self.mailbox.put("", ZenohQuestion(topic, query))

        self._queryable = seat.session.declare_queryable(
            seat.prefix + key, zenoh.handlers.Callback(bring, indirect=False)
        )

    def receive(self, timeout: float | None = 0.0) -> Question | None:
        return self.mailbox.take(timeout)


class ZenohAnswer(Answer):
    def __init__(self, topic: Topic, key: str, question: Message, timeout: float, seat: Seat) -> None:
        self._topic, self._key = topic, key
        mailbox: EveryMailbox[bytes | str] = EveryMailbox()
        self._mailbox = mailbox

        def bring(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                mailbox.put("", reply.ok.payload.to_bytes())
            elif reply.err is not None:
                mailbox.put("", reply.err.payload.to_string())

        def nobody() -> None:
            mailbox.put("", f"nobody answers {key}")

        seat.session.get(
            seat.prefix + key,
            zenoh.handlers.Callback(bring, nobody, indirect=False),
            payload=question.encode(),
            timeout=timeout,
        )

    def result(self, timeout: float) -> Any:
        reply = self._mailbox.take(timeout)
        if reply is None:
            raise NoAnswerError(f"nobody answers {self._key} within {timeout:g} s")
        if isinstance(reply, str):
            raise NoAnswerError(reply)
        assert self._topic.reply is not None
        return self._topic.reply.decode(reply)


class ZenohWatch(PresenceWatch):
    def __init__(self, seat: Seat) -> None:
        self.mailbox: EveryMailbox[Presence] = EveryMailbox()
        self.is_quiet = self.mailbox.is_empty
        start = len(seat.prefix)
        row = TOPICS["alive"]

        def bring(sample: zenoh.Sample) -> None:
            chunks = row.match(str(sample.key_expr)[start:])
            if chunks:
                alive = sample.kind == zenoh.SampleKind.PUT
                self.mailbox.put("", Presence(chunks["kind"], chunks["name"], alive))

        self._watch = seat.session.liveliness().declare_subscriber(
            seat.prefix + row.fill(), zenoh.handlers.Callback(bring, indirect=False), history=True
        )

    def receive(self, timeout: float | None = 0.0) -> Presence | None:
        return self.mailbox.take(timeout)
