"""Pages, gateways and hosts that come and go: a page shows it, and recovers by itself."""

from support.tunnel import Tunnel


def test_a_gateway_that_is_killed_and_started_again_finds_its_pages(match, gateway_of, visit) -> None:
    gateway = gateway_of(match.medium)
    tab = visit(gateway.origin, "referee")
    tab.loses_its_server = True
    gateway.close()
    tab.until("!document.getElementById('notice').hidden")
    assert "connection is broken" in tab.page.locator("#notice").inner_text()
    tab.page.keyboard.press("Space")
    tab.wait_for_log("refused: the page has no connection to the gateway")
    gateway_of(match.medium, port=gateway.port)
    tab.until("document.getElementById('notice').hidden && window.touchline.match.role === 'referee'")
    tick = tab.ask("window.touchline.match.frames.newest?.tick ?? 0")
    tab.until(f"window.touchline.pitchCanvas.world?.tick > {tick + 20}")
    tab.button("goal", "magenta").click()
    tab.until("document.getElementById('score').textContent === '0 : 1'")


def test_a_host_that_is_killed_and_started_again_is_waited_for(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("goal", "cyan").click()
    tab.until("document.getElementById('score').textContent === '1 : 0'")
    match.stop()
    tab.until("document.getElementById('notice').textContent.includes('The host has left')")
    assert tab.button("start").is_disabled()
    match.start()
    match.signal_kick_off()
    tab.until("document.getElementById('notice').hidden && document.getElementById('score').textContent === '0 : 0'")
    tab.until("window.touchline.pitchCanvas.world !== null && window.touchline.pitchCanvas.world?.time > 0.5")
    tab.button("goal", "magenta").click()
    tab.until("document.getElementById('score').textContent === '0 : 1'")


def test_a_line_that_is_dead_and_was_not_closed_is_noticed_and_tied_anew(match, gateway_of, visit, request) -> None:
    """As with a laptop that changes its network, or sleeps: nothing arrives any more, without any close."""
    tunnel = Tunnel(gateway_of(match.medium).port)
    request.addfinalizer(tunnel.close)
    tab = visit(f"http://127.0.0.1:{tunnel.port}", "referee")
    tab.button("start").click()
    tab.until("document.getElementById('phase').classList.contains('running')")
    tunnel.block()
    tab.until("document.getElementById('notice').textContent.includes('Nothing arrives any more')")  # before it breaks
    assert not tab.ask("document.getElementById('phase').classList.contains('running')")  # no green that is not known
    tab.ask("window.touchline.connection.patience = 2000")  # not 5 s, for which the test would wait
    tab.until("document.getElementById('notice').textContent.includes('The connection is broken')")
    tab.until("document.getElementById('notice').hidden && window.touchline.match.role === 'referee'")
    tick = tab.ask("window.touchline.match.frames.newest?.tick ?? 0")
    tab.until(f"window.touchline.match.frames.newest?.tick > {tick + 20}")
