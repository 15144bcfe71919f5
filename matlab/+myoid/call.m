function text = call(command, arguments, varargin)
  % CALL  Runs a command of the program.
  %   text = myoid.call(command, arguments, 'option', value, ...)
  % arguments: cell array of the words without dashes. An option is named as on the command line, with _ for -; true
  % gives the option without a value, false leaves the option out, a cell array or an array of numbers gives the option
  % several values. Values of other classes are refused.
  % Returns the standard output. Raises an error with the program's own message:
  %   myoid:commandLine (exit code 2), myoid:badInput (3), myoid:failed (1), myoid:interrupted (130).
  % The codes 4 (a quality gate failed) and 5 (some trials failed) have results: they are warnings.
  if mod(numel(varargin), 2) ~= 0
    error('myoid:commandLine', 'options come in pairs of a name and a value; found %d words', numel(varargin));
  end
  words = [{command}, arguments];
  for k = 1:2:numel(varargin)
    words = [words, option_words(varargin{k}, varargin{k + 1})]; %#ok<AGROW>
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

function words = option_words(name, value)
  % The words of one option.
  if ~ischar(name) && ~(isstring(name) && isscalar(name))
    error('myoid:commandLine', 'the name of an option is a text, found a value of class %s', class(name));
  end
  words = {['--' strrep(char(name), '_', '-')]};
  if islogical(value) && isscalar(value)
    if ~value
      words = {};
    end
    return
  end
  if isstring(value)
    value = cellstr(value);
  elseif isnumeric(value)
    value = num2cell(value);
  elseif ~iscell(value)
    value = {value};
  end
  if isempty(value)
    error('myoid:commandLine', 'option %s: the value is empty; leave the option out', char(name));
  end
  for j = 1:numel(value)
    one = value{j};
    if isstring(one) && isscalar(one)
      one = char(one);
    end
    if isnumeric(one) && isscalar(one) && isreal(one)
      words{end + 1} = sprintf('%.17g', one); %#ok<AGROW>
    elseif ischar(one) && (isrow(one) || isempty(one))
      words{end + 1} = one; %#ok<AGROW>
    else
      error('myoid:commandLine', ['option %s: a value of class %s and size %s is not understood; expected a text, a ' ...
                                  'real number, or a row or cell array of them'], ...
            char(name), class(one), mat2str(size(one)));
    end
  end
end

function word = quoted(text)
  if ispc()
    if any(text == '"')
      error('myoid:commandLine', 'a word with a quote cannot be given to the program: %s', text);
    end
    word = ['"' text '"'];
  else
    word = ['''' strrep(text, '''', '''\''''') ''''];
  end
end
