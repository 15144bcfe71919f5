function text = call(command, arguments, varargin)
  % CALL  Runs a command of the program.
  %   text = myoid.call(command, arguments, 'option', value, ...)
  % arguments: cell array of the words without dashes. An option is named as on the command line, with _ for -; true
  % gives the option without a value, false leaves the option out, a cell array gives the option several values.
  % Returns the standard output. Raises an error with the program's own message:
  %   myoid:commandLine (exit code 2), myoid:badInput (3), myoid:failed (1), myoid:interrupted (130).
  % The codes 4 (a quality gate failed) and 5 (some trials failed) have results: they are warnings.
  words = [{command}, arguments];
  for k = 1:2:numel(varargin)
    value = varargin{k + 1};
    option = ['--' strrep(varargin{k}, '_', '-')];
    if islogical(value) && isscalar(value)
      if value
        words{end + 1} = option; %#ok<AGROW>
      end
      continue
    end
    words{end + 1} = option; %#ok<AGROW>
    if ~iscell(value)
      value = {value};
    end
    for j = 1:numel(value)
      if isnumeric(value{j})
        words{end + 1} = sprintf('%.17g', value{j}); %#ok<AGROW>
      else
        words{end + 1} = value{j}; %#ok<AGROW>
      end
    end
  end
  line = quoted(myoid.program());
  for k = 1:numel(words)
    line = [line ' ' quoted(words{k})]; %#ok<AGROW>
  end
  log = tempname();
  [code, text] = system([line ' 2>' quoted(log)]);
  said = '';
  if exist(log, 'file')
    said = strtrim(fileread(log));
    delete(log);
  end
  switch code
    case 0
    case 4
      warning('myoid:gateFailed', '%s', ['a quality gate failed: ' said]);
    case 5
      warning('myoid:someFailed', '%s', said);
    case 2
      error('myoid:commandLine', '%s', said);
    case 3
      error('myoid:badInput', '%s', said);
    case 130
      error('myoid:interrupted', '%s', said);
    otherwise
      error('myoid:failed', 'exit code %d: %s', code, said);
  end
end

function word = quoted(text)
  if ispc()
    word = ['"' text '"'];
  else
    word = ['''' strrep(text, '''', '''\''''') ''''];
  end
end
